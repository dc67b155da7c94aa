#pragma once
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
    std::vector<std::uint8_t> instant;
};
constexpr std::size_t most_state_bytes = 4096;

/// A node has drawn a frame.
struct ReadyMessage {
    std::string node;
    std::int64_t frame = 0;
    std::uint64_t digest = 0; ///< of the instant's bytes
    double frame_ms = 0; ///< that it took to draw
    bool barrier = false; ///< its screens change with those of the others
    std::vector<ViewSamples> samples{}; ///< of its views; none where nothing is metered
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

/// A picture of the instruments' readings, which an instant names by its number.
struct PageMessage {
    std::int64_t number = 0;
    std::int32_t width = 0, height = 0; ///< pixels
    std::vector<std::uint8_t> texels; ///< page_bytes.h
};

/// The messages between the machines of one exhibit, on one network interface: topics of DDS (machines.idl). A node that
/// joins late receives the last state and every config.
class Bus {
public:
    /// The master sends states, goes and pages and receives readies; a node the other way round. Both send and receive
    /// configs. Nobody receives what concerns others: with N machines a frame has N messages and not N squared.
    enum class Role { master, node };

    /// interface: an interface's name ("enp3s0", "lo"), or a network ("192.168.7.0/24") of which this machine has an
    /// address. domain: from 0 to 200; two exhibits on one network have different ones. Throws InputError where this
    /// machine has no such interface, or it can't be opened.
    Bus(const std::string& interface, int domain, Role role);
    ~Bus();

    void send(const StateMessage& state);
    void send(const ReadyMessage& ready);
    void send(const GoMessage& go);
    void send(const ConfigMessage& config);
    void send(const PageMessage& page);

    /// The messages that have come since the last call; none of those that the role does not receive. Of states, goes and
    /// pages only the last counts.
    std::optional<StateMessage> state();
    std::optional<GoMessage> go();
    std::vector<ReadyMessage> readies();
    std::vector<ConfigMessage> configs();
    std::optional<PageMessage> page();

    /// Waits until something has come that was not taken, or for so long.
    void wait(std::chrono::nanoseconds longest);

private:
    struct Topics;
    std::unique_ptr<Topics> topics_;
};

} // namespace starbow
