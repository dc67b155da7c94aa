#include "ends.h"
#include "config/json/error.h"
#include "config/json/whole_file.h"
#include "log.h"
#include <algorithm>
#include <fstream>
#include <string>

namespace starbow {
namespace {

constexpr const char* running = "running";

} // namespace

Ends::Ends(const std::filesystem::path& folder, std::int64_t now_s)
    : file_(folder / "ends")
{
    std::ifstream stream(file_);
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
        std::error_code ignored;
        std::filesystem::create_directories(folder, ignored);
        write_whole(file_, text + running + "\n", Lasting::power_cut);
    } catch (const InputError& error) {
        log_warning("exhibit", std::string(error.what()) + "; crashes are not counted");
        times_.clear();
    }
}

void Ends::in_order() const
{
    std::error_code ignored;
    std::filesystem::remove(file_, ignored);
}

} // namespace starbow
