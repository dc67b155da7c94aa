#pragma once
#include "runtime/remote/remote.h"
#include "session.h"
#include <chrono>
#include <optional>

namespace starbow {

/// The exhibit's side of its remote: commands come in with the frame's controls, and are answered when their picture is
/// shown; the exhibit's state goes out. Without a remote all of it does nothing.
class RemoteControl {
public:
    using Clock = std::chrono::steady_clock;
    /// Opens the remote that the exhibit's file describes. Throws InputError as Remote does.
    explicit RemoteControl(const ExhibitOptions& options);

    /// Adds the commands that have arrived to the frame's.
    void read(std::vector<Command>& commands);
    /// Notes a command's end, in the order of read. refusal: the reason; empty: it is carried out.
    void note(const std::string& refusal);
    /// The command at an index of those that are read and not noted waits for a world; one that waits already is refused.
    void defer(std::size_t index);
    /// The waiting command is carried out in this frame after all others, or is refused.
    void resume(const std::string& refusal = {});
    /// The frame with these commands is on the screens, or will never be. Answers them and publishes the state.
    void shown(const Session& session);
    /// The counts' text is a new one: publishes it and the last lines of the log.
    void publish_condition(const Session& session);

    /// True once a second while anybody looks at the live picture.
    bool wants_picture();
    /// Publishes what `take` writes into its argument, unless the returned size is 0.
    template <class Take> void publish_picture(const Take& take)
    {
        if (!remote_)
            return;
        LivePicture& picture = remote_->next_picture();
        const glm::ivec2 size = take(picture.rgb);
        if (size.x == 0)
            return;
        picture.width = size.x, picture.height = size.y;
        remote_->publish_picture();
    }
    /// A sentence about the server's missing places on the network; empty: none is missing, or there is no remote.
    std::string lack() { return remote_ ? remote_->lack() : ""; }
    /// The PINs that were drawn at the start, as a line for the operator; empty where a file has them, or without a remote.
    std::string drawn_pins() const;

private:
    struct Pending {
        std::uint64_t number;
        std::string refusal;
    };
    std::unique_ptr<Remote> remote_;
    std::vector<Pending> pending_; ///< of this frame, in order
    std::optional<std::uint64_t> deferred_; ///< the number of the command that waits
    std::size_t noted_ = 0;
    Clock::time_point published_{}, pictured_{};
};

} // namespace starbow
