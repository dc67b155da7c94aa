#pragma once
#include "flight_source.h"
#include "runtime/flight/history.h"
#include "runtime/flight/replay.h"

namespace starbow {

/// A flown record that is shown as it was flown, in its own time, whatever the frames' times are now.
class ShownRecord : public FlightSource {
public:
    /// Throws InputError, also where the record's first frames are wrong.
    explicit ShownRecord(const std::filesystem::path& file);

    /// The flight dt_ns nanoseconds later. A record is over where it is damaged, and at a command that only an exhibit
    /// carries out.
    const Flight& advance(const Controls& hands, std::int64_t dt_ns) override;
    const Flight& flight() const override { return flight_; }
    bool over() const override { return !next_; }
    double begun_ev() const override { return header().start.exposure_ev; }
    Flight* switched() override { return &flight_; }
    const RecordHeader& header() const { return replay_.header(); }

private:
    void read_next();

    Replay replay_;
    Flight flight_;
    History history_;
    std::optional<RecordEntry> next_;
    std::int64_t waits_ns_ = 0; ///< until the next frame is due
};

} // namespace starbow
