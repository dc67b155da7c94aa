#pragma once
#include "bus.h"
#include <map>
#include <set>

namespace starbow {

/// A change of a node, for the log.
struct NodeEvent {
    enum class Kind { joins, leaves, differs, doubled } kind; ///< doubled: two programs have the node's name
    std::string node;
    std::int64_t frame; ///< the one at which it happened
};

/// The master's count of the nodes in step. A frame goes when all of them are ready, or after a bound. A node that was not
/// ready for silent_frames frames in turn is out, until it is ready again. Times are the caller's.
class Gate {
public:
    static constexpr int silent_frames = 6;
    /// Bounds of the wait for those who are in, seconds: twice the slowest one's last frame, and no less than this.
    static constexpr double least_wait_s = 0.02, most_wait_s = 0.25;

    /// nodes: all that the layout has, without the master itself.
    explicit Gate(const std::set<std::string>& nodes);

    /// Other nodes: those of another layout. Known ones stay as they are.
    void have(const std::set<std::string>& nodes);
    /// The frame that is drawn now, with the digest of its state. leapt: its picture has nothing to do with the one before.
    void begin(std::int64_t frame, std::uint64_t digest, bool leapt = false);
    /// A node's word. Of unknown nodes nothing is heard.
    void hear(ReadyMessage ready);
    /// A node whose files differ from the master's is not let in; again: until it says other files.
    void refuse(const std::string& node, bool refused);
    /// No frame is sent: nobody is in, until it is ready for a later one.
    void let_all_out();
    /// True when all who are in are ready for the frame.
    bool complete() const;
    /// The time that the slowest node in step has taken to draw a frame, ms.
    double slowest_ms() const;
    /// The luminance samples of the nodes in step, as they last said; none of a frame before the last leap.
    std::vector<ViewSamples> samples() const;
    bool somebody_in() const;
    /// True when the screens of all who are in change together.
    bool barrier() const;
    /// Seconds that the frame may wait from its beginning on.
    double bound_s() const;
    /// Ends the frame. Returns the nodes in step with it.
    GoMessage go();

    std::vector<NodeEvent> take_events() { return std::exchange(events_, {}); }

    struct Node {
        bool in = false, refused = false;
        std::int64_t heard = -1; ///< the last frame that it was ready for
        int silent = 0; ///< frames in turn
        double frame_ms = 0;
        bool barrier = false; ///< as ReadyMessage's
        std::vector<ViewSamples> samples{};
        std::uint64_t sender = 0, sender_before = 0; ///< of its last word, and the last other one
        bool doubled = false; ///< known since it joined
    };
    const std::map<std::string, Node>& nodes() const { return nodes_; }

private:
    std::map<std::string, Node> nodes_;
    std::int64_t frame_ = -1;
    std::int64_t leapt_ = -1; ///< the frame of the last leap
    std::uint64_t digest_ = 0;
    std::vector<NodeEvent> events_;
};

} // namespace starbow
