#pragma once
#include "exhibit.h"
#include "runtime/machines/frame_log.h"
#include "runtime/machines/gate.h"
#include "runtime/machines/instant_bytes.h"

namespace starbow {

/// The master of several machines: it says what is drawn, waits until the nodes have drawn it, and says when it is shown.
class Master {
public:
    /// Throws InputError where the network can't be opened.
    explicit Master(const ExhibitOptions& options);

    /// Sends the next frame's instant; the nodes draw it while the master does.
    void send(const SharedInstant& shared);
    /// Waits until all who are in have drawn the frame, or for the gate's bound; then all show it.
    void go();

    /// The luminance samples of the nodes in step, as they last said.
    std::vector<ViewSamples> samples() const;
    std::size_t nodes() const { return gate_.nodes().size(); } ///< without the master
    std::size_t nodes_in_step() const;
    /// The names of the nodes that are not in step, with commas; empty where all are.
    std::string missing() const;
    /// The time that the slowest node in step has taken to draw a frame, ms.
    double slowest_ms() const { return gate_.slowest_ms(); }
    /// The name by which the nodes find a scene: shared_name_of_scene's, looked up once.
    const std::string& name_of(const std::filesystem::path& scene);

private:
    using Clock = std::chrono::steady_clock;
    void hear();
    void report();

    Bus bus_;
    ConfigMessage config_;
    Gate gate_;
    std::map<std::string, std::vector<ViewSamples>> samples_; ///< by node
    std::map<std::string, std::string> refusals_; ///< by node, as last logged
    std::map<std::filesystem::path, std::string> names_; ///< of scenes
    FrameLog log_;
    std::int64_t frame_; ///< of the last state
    std::uint64_t digest_ = 0;
    Clock::time_point begun_{};
    std::string too_long_; ///< the last complaint about a state
};

} // namespace starbow
