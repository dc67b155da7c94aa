#include "frame_log.h"
#include "config/json/whole_file.h"
#include <chrono>
#include <cinttypes>
#include <fcntl.h>

namespace starbow {

FrameLog::FrameLog(const std::filesystem::path& file)
    : file_(nullptr, std::fclose)
{
    if (file.empty())
        return;
    file_.reset(fdopen(open_to_write(file, O_TRUNC, "a file in a folder that can be written to"), "w"));
    std::setvbuf(file_.get(), nullptr, _IOLBF, 4096);
    std::fputs("steady_ns,frame,digest,drawn_ms\n", file_.get());
}

void FrameLog::add(std::int64_t frame, std::uint64_t digest, double drawn_ms)
{
    using namespace std::chrono;
    if (!file_)
        return;
    const std::int64_t now = duration_cast<nanoseconds>(steady_clock::now().time_since_epoch()).count();
    std::fprintf(file_.get(), "%" PRId64 ",%" PRId64 ",%016" PRIx64 ",%.3f\n", now, frame, digest, drawn_ms);
}

} // namespace starbow
