#pragma once
#include "mailbox.h"
#include "remote.h"
#include "triple_buffer.h"
#include <atomic>

namespace starbow {

/// The frame thread's answer to a command.
struct Reply {
    std::uint64_t number = 0;
    std::string refusal; ///< empty: applied
};

/// All that the frame thread and the server's thread share.
struct Exchange {
    Mailbox<NumberedCommand, 64> commands;
    Mailbox<Reply, 128> replies;
    TripleBuffer<Snapshot> snapshots;
    TripleBuffer<Condition> conditions;
    TripleBuffer<LivePicture> pictures;
    TripleBuffer<std::string> lacks; ///< of the server's places on the network, as Awaited's
    std::atomic<bool> picture_wanted{false};
    std::atomic<bool> ends{false};
};

} // namespace starbow
