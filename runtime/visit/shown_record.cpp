#include "shown_record.h"
#include "config/json/error.h"

namespace starbow {

ShownRecord::ShownRecord(const std::filesystem::path& file)
    : replay_(file)
    , flight_(flight_at(replay_.header().start, replay_.header().rules))
    , next_(replay_.next())
{
    waits_ns_ = next_ ? next_->dt_ns : 0;
}

void ShownRecord::read_next()
{
    try {
        replay_.compare(flight_); // reads on to the next frame
        next_ = replay_.next();
        if (next_ && exhibits_command(*next_))
            next_.reset();
    } catch (const InputError&) { // what follows can't be flown
        next_.reset();
    }
}

const Flight& ShownRecord::advance(const Controls&, std::int64_t dt_ns)
{
    const RecordHeader& header = replay_.header();
    waits_ns_ -= dt_ns;
    while (next_ && waits_ns_ <= 0) {
        flight_ = starbow::flown(
            flight_, history_, next_->controls, next_->dt_ns, header.rules, header.seconds_per_time_unit, header.start);
        read_next();
        waits_ns_ += next_ ? next_->dt_ns : 0;
    }
    return flight_;
}

} // namespace starbow
