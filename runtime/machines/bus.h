#pragma once
#include "config/model/awaited.h"
#include "following.h"
#include "runtime/light/exposure.h"
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace starbow {

/// A frame that is to be drawn: the state's bytes, at most most_state_bytes.
struct StateMessage {
    std::int64_t frame = 0;
    std::vector<std::uint8_t> bytes; ///< of a SharedState
    std::uint64_t master = 0; ///< as Rival's
    std::int64_t led_ms = 0;
};
constexpr std::size_t most_state_bytes = 4096;

/// A node has drawn a frame.
struct ReadyMessage {
    std::string node;
    std::int64_t frame = 0;
    std::uint64_t digest = 0; ///< of the state's bytes
    double frame_ms = 0; ///< that it took to draw
    bool barrier = false; ///< its screens change with those of the others
    std::vector<ViewSamples> samples{}; ///< of its views; none where nothing is metered
    std::uint64_t sender = 0; ///< the program that has sent it, as the network tells them apart
};

/// A frame is to be shown by all who are in step.
struct GoMessage {
    std::int64_t frame = 0;
    std::vector<std::string> members;
};

/// Names of files and their digests, in the same order on each node.
using FileDigests = std::vector<std::pair<std::string, std::string>>;

/// The files that a node's pictures depend on.
struct ConfigMessage {
    std::string node;
    FileDigests files; ///< program, scene, words
    FileDigests layout; ///< the layout's own, then its calibrations
};

/// A picture of the instruments' readings, which a state names by its number.
struct PageMessage {
    std::int64_t number = 0;
    std::int32_t width = 0, height = 0; ///< pixels
    std::vector<std::uint8_t> texels; ///< page_bytes.h
};

/// The network interface and the DDS domain of an exhibit's machines, and the exhibit's identity there.
struct BusPlace {
    std::string interface; ///< an interface's name ("enp3s0", "lo"), or a network ("192.168.7.0/24") of which this machine
                           ///< has an address
    int domain = 0; ///< from 0 to 200
    std::string exhibit; ///< its identity: messages of others on the same domain are left out
};

/// The messages between the machines of one exhibit, on one network interface: topics of DDS (machines.idl). A node that
/// joins late receives the last state and every config. While this machine lacks the interface nothing is sent and nothing
/// comes. A message that is damaged, or of another exhibit, is left out, and the log has a line of such ones a minute.
class Bus {
public:
    /// The master sends states, goes and pages and receives readies, and the states of other masters; a node the other way
    /// round, of the one master that it follows. Both send and receive configs. Nobody receives what concerns others: with N
    /// machines a frame has N messages and not N squared.
    enum class Role { master, node };

    /// Throws InputError for a text that is no interface and no network.
    Bus(BusPlace place, Role role, LogTo log);
    ~Bus();
    Bus(Bus&&) noexcept;

    /// Opens the network once the interface is there, and again after it was away; then the last config and page are sent
    /// again. For each frame. Returns true where it was opened just now.
    bool follow();
    /// A sentence about an interface that is missing; empty: none is.
    const std::string& lack() const { return awaited_.lack(); }
    /// The names of nodes that are heard; of others, a few alone.
    void know(const std::vector<std::string>& nodes);

    void send(const StateMessage& state);
    void send(const ReadyMessage& ready);
    void send(const GoMessage& go);
    void send(const ConfigMessage& config);
    void send(const PageMessage& page);

    /// The messages that have come since the last call; none of those that the role does not receive. Of states, goes and
    /// pages only the last counts. A node receives no others before its first state, which says whom it follows.
    std::optional<StateMessage> state();
    std::optional<GoMessage> go();
    std::vector<ReadyMessage> readies();
    std::vector<ConfigMessage> configs();
    std::optional<PageMessage> page();
    /// The master that a node follows; another number, or none: another one, or it is gone.
    std::optional<std::uint64_t> master() const { return following_.master(); }

    /// Waits until something has come that was not taken, or for so long.
    void wait(std::chrono::nanoseconds longest);

private:
    struct Topics;
    struct Doors;

    void open(Awaited::Time now);
    /// The state's writer that is followed is gone.
    void drop_gone(Awaited::Time now);
    void report(Awaited::Time now);

    BusPlace place_;
    Role role_;
    LogTo log_;
    Awaited awaited_;
    std::unique_ptr<Doors> doors_; ///< outlives topics_
    std::unique_ptr<Topics> topics_; ///< null: the interface was never there
    std::optional<Awaited::Time> looked_, reported_; ///< for the interface; to the log
    std::optional<ConfigMessage> config_; ///< the last ones
    std::optional<PageMessage> page_;
    Following following_;
    std::int64_t frame_ = -1; ///< of the followed master's last state
};

} // namespace starbow
