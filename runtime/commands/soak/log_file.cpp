#include "log_file.h"
#include "config/json/error.h"
#include "config/json/whole_file.h"
#include "config/markup/svg.h"
#include "runtime/commands/median.h"
#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <fcntl.h>
#include <sstream>
#include <unistd.h>

namespace starbow {
namespace {

constexpr const char* columns
    = "visit,frames,seconds,resident_bytes,heap_bytes,files,threads,driver_pieces,driver_bytes,temporary_files";

std::string head_of(const std::string& use, long seed, long repeat)
{
    return "# starbow soak, " + use + ", seed " + std::to_string(seed)
        + (repeat > 0 ? ", the same visitors after " + std::to_string(repeat) + " visits" : "");
}

struct Quantity {
    const char* name;
    std::size_t SoakSample::*value;
    double unit; ///< of the table
    double most; ///< greatest part by which it may have grown
    double per_device = 0; ///< number of them that a device has while it is plugged in, at most
};

/// A driver frees pipelines by their age, so the number of its pieces, too, is compared as memory is.
constexpr Quantity quantities[] = {{"memory in the machine, MB", &SoakSample::resident_bytes, 1e6, 0.01},
    {"memory in use, MB", &SoakSample::heap_bytes, 1e6, 0.01}, {"open files", &SoakSample::files, 1, 0, 2},
    {"threads", &SoakSample::threads, 1, 0, 1}, {"pieces of Vulkan objects", &SoakSample::driver_pieces, 1, 0.01},
    {"their memory, MB", &SoakSample::driver_bytes, 1e6, 0.01}, {"temporary files", &SoakSample::temporary_files, 1, 0}};

double median_of(std::span<const SoakSample> samples, std::size_t SoakSample::*value)
{
    std::vector<double> values;
    for (const SoakSample& sample : samples)
        values.push_back(double(sample.*value));
    return median(std::move(values));
}

} // namespace

SoakLog::SoakLog(const std::filesystem::path& file, const std::string& use, long seed, long repeat)
    : file_(file)
{
    const std::string head = head_of(use, seed, repeat);
    std::istringstream stream(RegularFile(file).read_all(std::size_t(64) << 20));
    std::string line;
    if (!std::getline(stream, line)) {
        make_folder_of(file);
        write_whole(file, head + "\n" + columns + "\n");
        return;
    }
    if (line != head)
        throw InputError(file.string() + ":1", "",
            line.substr(0, 60) + " is not how this soak begins; '" + head + "', or a new file, is right");
    for (int number = 2; std::getline(stream, line); ++number) {
        if (line == columns)
            continue;
        SoakSample s;
        if (std::sscanf(line.c_str(), "%ld,%ld,%lf,%zu,%zu,%zu,%zu,%zu,%zu,%zu", &s.visit, &s.frames, &s.seconds,
                &s.resident_bytes, &s.heap_bytes, &s.files, &s.threads, &s.driver_pieces, &s.driver_bytes,
                &s.temporary_files)
            != 10)
            throw InputError(file.string() + ":" + std::to_string(number), "",
                line.substr(0, 60) + " is not a sample; ten numbers with commas are right");
        before_.push_back(s);
    }
}

long SoakLog::next_visit() const
{
    const std::vector<SoakSample>& all = samples_.empty() ? before_ : samples_;
    return all.empty() ? 0 : all.back().visit + 1;
}

void SoakLog::add(const SoakSample& s)
{
    samples_.push_back(s);
    std::ostringstream stream;
    stream << s.visit << ',' << s.frames << ',' << s.seconds << ',' << s.resident_bytes << ',' << s.heap_bytes << ','
           << s.files << ',' << s.threads << ',' << s.driver_pieces << ',' << s.driver_bytes << ',' << s.temporary_files
           << '\n';
    const std::string text = stream.str();
    const int to = open_to_write(file_, O_APPEND, "a file that can be written");
    const bool whole = ::write(to, text.data(), text.size()) == ssize_t(text.size());
    ::close(to);
    if (!whole)
        refuse_writing(file_, errno);
}

SoakResult SoakLog::result(long settled, int devices) const
{
    const std::vector<SoakSample>& all = samples_.empty() ? before_ : samples_;
    if (all.empty())
        return {"no visit was sampled\n"};
    const long first = all.front().visit, visits = all.back().visit - first;
    const long from = first + std::min(settled, visits / 3);
    const auto begin = std::ranges::lower_bound(all, from, {}, &SoakSample::visit);
    const std::size_t of = std::clamp<std::size_t>(std::size_t(all.end() - begin) / 3, 1, 20);
    const std::span<const SoakSample> early(&*begin, of), late(&all.back() - (of - 1), of);
    SoakResult result;
    std::array<char, 160> line;
    std::snprintf(line.data(), line.size(), "%-28s %12s %12s  %s\n",
        (std::to_string(all.back().frames) + " frames in " + std::to_string(std::lround(all.back().seconds)) + " s").c_str(),
        ("visit " + std::to_string(early.front().visit)).c_str(), ("visit " + std::to_string(late.back().visit)).c_str(),
        "growth");
    result.text = line.data();
    for (const Quantity& quantity : quantities) {
        const double before = median_of(early, quantity.value), after = median_of(late, quantity.value);
        const double growth = before > 0 ? after / before - 1 : after > 0 ? 1 : 0;
        // A process that shrinks has lost nothing. Caches fill during the first visits, so that memory is judged after them.
        const bool steady = after - before <= quantity.most * before + quantity.per_device * devices
            || (quantity.most > 0 && visits < settled);
        result.steady = result.steady && steady;
        std::snprintf(line.data(), line.size(), "%-28s %12.*f %12.*f  %+.2f %%%s\n", quantity.name,
            quantity.unit > 1 ? 2 : 0, before / quantity.unit, quantity.unit > 1 ? 2 : 0, after / quantity.unit,
            100 * growth, steady ? "" : "  has grown");
        result.text += line.data();
    }
    if (visits < settled)
        result.text += "Memory is judged from visit " + std::to_string(settled) + " on.\n";
    return result;
}

void SoakLog::draw() const
{
    std::vector<SoakSample> all = before_;
    all.insert(all.end(), samples_.begin(), samples_.end());
    if (all.size() < 2)
        return;
    constexpr double width = 800, height = 320, left = 70, foot = 40;
    double most = 0;
    for (const SoakSample& sample : all)
        most = std::max(most, double(sample.resident_bytes));
    most = std::ceil(most / 1e8) * 1e8;
    const double visits = std::max(1.0, double(all.back().visit));
    const auto y_of = [&](double bytes) { return height - foot - (height - foot - 30) * bytes / most; };
    Svg svg;
    svg.rect({0, 0}, {width, height}, "fill=\"#ffffff\"");
    for (int i = 0; i <= 4; ++i) {
        const double y = y_of(most * i / 4);
        svg.line({left, y}, {width - 20, y}, "stroke=\"#dddddd\"");
        svg.text({left - 8, y + 4}, std::to_string(std::lround(most / 1e6 * i / 4)) + " MB",
            "fill=\"#333333\" text-anchor=\"end\"");
    }
    const auto curve = [&](std::size_t SoakSample::*value, const std::string& colour, double at, const char* name) {
        std::vector<glm::dvec2> points;
        for (const SoakSample& sample : all)
            points.emplace_back(left + (width - left - 20) * double(sample.visit) / visits, y_of(double(sample.*value)));
        svg.polyline(points, "fill=\"none\" stroke-width=\"1.5\" " + attribute("stroke", colour));
        svg.text({left + at, 18}, name, attribute("fill", colour));
    };
    curve(&SoakSample::resident_bytes, "#0b5fa5", 0, "memory in the machine");
    curve(&SoakSample::heap_bytes, "#c2410c", 190, "in use");
    curve(&SoakSample::driver_bytes, "#15803d", 260, "Vulkan objects");
    svg.text(
        {width - 20, height - 12}, std::to_string(all.back().visit) + " visits", "fill=\"#333333\" text-anchor=\"end\"");
    std::filesystem::path picture = file_;
    write_whole(
        picture.replace_extension(".svg"), svg.drawn({width, height}, "font-family=\"sans-serif\" font-size=\"13\""));
}

} // namespace starbow
