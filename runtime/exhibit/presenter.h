#pragma once
#include "runtime/hud/presenter_picture.h"
#include "runtime/operation/monitors.h"
#include "runtime/remote/triple_buffer.h"
#include "session.h"
#include <atomic>
#include <chrono>
#include <functional>
#include <semaphore>
#include <thread>

namespace starbow {

/// Paints the guide's window on a thread of its own of low priority, so that no frame waits for letters.
class PresenterPainter {
public:
    /// load: makes the small pictures, on the thread.
    explicit PresenterPainter(std::function<Thumbnails()> load);
    ~PresenterPainter();
    PresenterPainter(const PresenterPainter&) = delete;

    struct Order {
        PresenterSheet sheet;
        SmallPicture view;
        glm::ivec2 size{0};
        bool blue_first = false;
    };
    /// The place to write the next order; ask() hands it over. Orders that a newer one overtakes are left out.
    Order& next() { return orders_.next(); }
    void ask();
    /// The picture painted last; null where there is none since the last call.
    const PresenterPicture* take();

private:
    void work(const std::function<Thumbnails()>& load);

    TripleBuffer<Order> orders_;
    TripleBuffer<PresenterPicture> pictures_;
    std::counting_semaphore<> asked_{0};
    std::atomic<bool> ends_{false};
    std::thread thread_;
};

/// The guide's side of the exhibit: what is open in the guide's window, the commands that it has given, and its state to
/// be shown. It outlives the loss of a device; without a guide's window all of it does nothing.
class Presenter {
public:
    using Clock = std::chrono::steady_clock;
    explicit Presenter(const ExhibitOptions& options);
    ~Presenter();

    bool wanted() const { return painter_ != nullptr && !closed_; }
    /// The guide has closed the window: it stays away until the exhibit starts anew.
    void close();

    /// Adds the commands that were given since the last call to the frame's.
    void read(std::vector<Command>& commands);
    /// Notes a command's end, whoever gave it. refusal: the reason; empty: it is carried out.
    void note(const Command& command, const std::string& refusal, const Words& words);

    /// A key of the window, by keys, or a click at a place of it.
    void press(int key);
    void click(glm::ivec2 at);
    /// The mouse is pressed at a place of the window, and may be moved there: in the visitors' picture it points at what is
    /// seen there.
    void point(glm::ivec2 at);
    void type(char32_t character);
    bool types() const { return hands_.typed.has_value(); } ///< keys write a caption

    /// True ten times a second, and at once after a press, if a picture shall be painted.
    bool due();
    /// True five times a second: a copy of the visitors' picture shall be made.
    bool wants_view();
    SmallPicture& view() { return view_; }
    /// Has the window painted in its present state.
    void paint(const Session& session, glm::ivec2 size, bool blue_first);
    const PresenterPicture* painted() { return painter_->take(); }

    bool seen = false; ///< the window is open, and not minimised
    std::optional<WindowPlace> kept_place{}; ///< of the window before the loss of a device

private:
    std::unique_ptr<PresenterPainter> painter_; ///< null without a guide's window
    bool closed_ = false;
    PresenterHands hands_{};
    PresenterState state_; ///< as last painted, and after the commands since
    PresenterSheet sheet_; ///< of it
    Words words_; ///< the exhibit's
    glm::ivec2 size_{0}; ///< the window's, then
    std::vector<Command> given_;
    std::string said_;
    bool refused_ = false;
    SmallPicture view_;
    std::vector<std::string> scenes_, tours_, shots_; ///< names of shipped ones
    std::vector<std::pair<std::string, std::string>> languages_; ///< name, and its own word
    bool pressed_ = false; ///< since the last painting
    Clock::time_point painted_{}, viewed_{}, pointed_{};
};

} // namespace starbow
