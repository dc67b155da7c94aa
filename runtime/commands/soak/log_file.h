#pragma once
#include <array>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace starbow {

/// The process after a visit.
struct SoakSample {
    long visit = 0;
    long frames = 0; ///< of this process
    double seconds = 0; ///< of this process
    std::size_t resident_bytes = 0, heap_bytes = 0, files = 0, threads = 0, driver_pieces = 0, driver_bytes = 0,
                temporary_files = 0;
};

struct SoakResult {
    std::string text; ///< a table for people
    bool steady = true;
};

/// The samples of a soak, in a CSV file that outlives the process.
class SoakLog {
public:
    /// Reads the file if it is there. Throws InputError for a file of another kind, another use, another seed or
    /// another number of visits after which the same visitors come again (0: never).
    SoakLog(const std::filesystem::path& file, const std::string& use, long seed, long repeat);

    /// The visit after the last sample, 0 without one.
    long next_visit() const;
    /// Appends a line. Throws InputError.
    void add(const SoakSample& sample);
    /// Compares the medians of this process's first samples after the settled visit with those of its last ones: memory may
    /// have grown by a hundredth, and counts not at all but by those of the devices, which may be plugged in at one sample
    /// and not at another. Before the settled visit memory is not judged.
    SoakResult result(long settled, int devices) const;
    /// Draws the memory over the visits, as an SVG picture beside the file.
    void draw() const;

private:
    std::filesystem::path file_;
    std::vector<SoakSample> before_; ///< of earlier processes
    std::vector<SoakSample> samples_;
};

} // namespace starbow
