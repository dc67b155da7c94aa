#include "crash_counter.h"
#include "config/json/error.h"
#include "config/json/whole_file.h"
#include "log.h"
#include <algorithm>
#include <sstream>
#include <string>

namespace starbow {
namespace {

constexpr const char* running = "running";

} // namespace

CrashCounter::CrashCounter(const std::filesystem::path& folder, std::int64_t now_s)
    : file_(folder / "ends")
{
    std::istringstream stream(RegularFile(file_).read_all(1 << 16));
    for (std::string line; std::getline(stream, line) && times_.size() < 1000;)
        if (line == running)
            times_.push_back(now_s);
        else if (!line.empty() && line.size() < 18 && line.find_first_not_of("0123456789") == line.npos)
            times_.push_back(std::stoll(line));
    // A clock that was set back leaves times to come; they say nothing.
    std::erase_if(times_, [&](std::int64_t time) { return time > now_s || time <= now_s - ends_within_s; });
    std::string text;
    for (const std::int64_t time : times_)
        text += std::to_string(time) + "\n";
    try {
        text += std::string(running) + "\n";
        write_own(file_, text, Durability::fsync);
    } catch (const InputError& error) {
        write_log(LogKind::ends_unwritten, std::string(error.what()) + "; crashes are not counted");
        times_.clear();
    }
}

void CrashCounter::in_order() const
{
    std::error_code ignored;
    std::filesystem::remove(file_, ignored);
}

} // namespace starbow
