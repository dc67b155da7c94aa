#pragma once
#include "exhibit.h"
#include "runtime/machines/frame_log.h"
#include "runtime/machines/gate.h"
#include "runtime/machines/shared_state.h"
#include "runtime/operation/machine_health.h"

namespace starbow {

/// The master of several machines: it says what is drawn, waits until the nodes have drawn it, and says when it is shown.
class Master {
public:
    /// layout: that of its file. A network that this machine does not have yet is taken up once it is there.
    Master(const ExhibitOptions& options, const Layout& layout);

    /// Another layout, with its files' digests: nodes whose files differ are left out.
    void adopt(const Layout& layout, FileDigests digests);
    /// The digest of the layout's files, which the nodes compare with their own.
    std::uint64_t layout_digest() const { return layout_digest_; }

    /// Sends the next frame's state, before it the instruments' page if that is a new one; the nodes draw it while the
    /// master does. leapt: the picture has nothing to do with the one before. While another master of this exhibit leads,
    /// nothing is sent.
    void send(const SharedState& shared, bool leapt);
    /// True where somebody waits until the master has drawn the frame: nodes in step, or the log of frames.
    bool awaits_drawing() const { return log_.is_open() || gate_.somebody_in(); }
    /// A sentence about what keeps it from leading: the network, or another master; empty: nothing.
    std::string lack() const;
    /// Waits until all who are in have drawn the frame, or for the gate's bound; then all show it.
    void go();

    std::vector<ViewSamples> samples() const { return gate_.samples(); } ///< Gate's
    /// The master and its nodes. machines: its memory is used again.
    void describe(std::vector<MachineHealth>& machines) const;
    /// The time that the slowest node in step has taken to draw a frame, ms.
    double slowest_ms() const { return gate_.slowest_ms(); }
    /// True when the screens of all nodes in step change together, by their graphics cards.
    bool nodes_barrier() const { return gate_.barrier(); }
    /// The name by which the nodes find a scene or a layout: shared_name's, looked up once.
    const std::string& name_of(const std::string& kind, const std::filesystem::path& file);

private:
    using Clock = std::chrono::steady_clock;
    struct Refusal {
        std::string why; ///< empty: none
        Clock::time_point since{};
        bool logged = false;
    };

    /// Listens to other masters. Returns true where this one leads.
    bool leads();
    void hear();
    void judge(const ConfigMessage& config);
    void report();

    Machines machines_;
    std::uint64_t number_; ///< Rival's
    Bus bus_;
    std::optional<Leading> leading_; ///< since the network is open
    bool leads_ = false, contested_ = false; ///< another master is heard
    std::int64_t rivals_frame_ = -1; ///< the last one heard
    std::optional<Clock::time_point> rival_followed_; ///< the last word of a node that draws its states
    ConfigMessage config_;
    Gate gate_;
    std::map<std::string, ConfigMessage> configs_; ///< by node, as last heard
    std::map<std::string, Refusal> refusals_; ///< by node
    std::map<std::filesystem::path, std::string> names_; ///< of scenes and layouts
    std::uint64_t layout_digest_;
    std::int64_t page_ = 0; ///< the last one sent
    FrameLog log_;
    std::int64_t frame_; ///< of the last state
    std::uint64_t digest_ = 0;
    Clock::time_point begun_{};
    double drawn_ms_ = 0; ///< the last frame, here
    std::string too_long_; ///< the last complaint about a state
};

} // namespace starbow
