#include "exhibit.h"
#include "config/json/error.h"
#include "config/model/shipped.h"
#include "frame_loop.h"
#include "runtime/operation/log.h"
#include "runtime/operation/messages.h"
#include "runtime/operation/waits.h"
#include <cmath>
#include <cstdio>
#include <memory>
#include <thread>
#include <unistd.h>

namespace starbow {
namespace {

using Clock = std::chrono::steady_clock;

/// A lost GPU, as after a hang of its driver, or one that has run out of memory, is opened anew and the flight goes on.
/// After so many losses, each within a minute of the one before, the program gives up.
constexpr int most_losses = 5;
/// The same where no opening has led to a picture for so long, s: a driver may take its time to come back.
constexpr double patience_s = 60;

struct Loss {
    std::string how, why;
};

Loss loss_by(const std::exception& error)
{
    if (dynamic_cast<const vk::DeviceLostError*>(&error))
        return {"is lost", error.what()};
    if (dynamic_cast<const std::bad_alloc*>(&error))
        return {"has failed", "the memory is used up"};
    return {"has failed", error.what()};
}

/// The losses of the GPU, or of all else that a flight needs.
class DeviceLosses {
public:
    explicit DeviceLosses(const Session& session)
        : session_(session)
    {
    }
    bool none() const { return losses_ == 0 && tries_ == 0; }

    bool flew() const { return session_.shown > shown_; } ///< pictures were shown since the device was opened

    /// The device is opened, for the first time or anew.
    void opens()
    {
        opened_ = Clock::now();
        shown_ = session_.shown;
    }

    /// Counts a loss, logs it, and waits a while. Returns false where the program shall give up, which is logged, too.
    bool survives(const Loss& loss)
    {
        const Clock::time_point now = Clock::now();
        if (flew()) {
            losses_ = seconds(now - opened_) > 60 ? 1 : losses_ + 1;
            tries_ = 0, away_since_ = now;
        } else
            ++tries_;
        if (losses_ > most_losses || seconds(now - away_since_) > patience_s) {
            write_log(LogKind::gpu_given_up, "the GPU " + loss.how + " again and again (" + loss.why + ")");
            return false;
        }
        if (std::exchange(logged_, loss.why) != loss.why || tries_ == 0) // the reason of many openings in turn is one line
            write_log(LogKind::gpu_lost, "the GPU " + loss.how + " (" + loss.why + "); it is opened again");
        wait(tries_ > 0 ? std::min(0.25 * std::exp2(tries_ - 1), 5.0) : losses_ - 1.0);
        return true;
    }

private:
    void wait(double wait_s) const
    {
        const Clock::time_point began = Clock::now();
        while (seconds(Clock::now() - began) < wait_s && !is_over(session_))
            std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }

    const Session& session_;
    int losses_ = 0; ///< after a picture
    int tries_ = 0; ///< openings in turn without a picture
    long shown_ = 0; ///< pictures when the device was opened
    Clock::time_point opened_{}, away_since_ = Clock::now();
    std::string logged_;
};

/// Prints the closing lines: the flight's last readings and the skew of the screens.
void print_summary(const Session& session, const SceneFile& scene)
{
    Readings last = readings(session.flight().ship, scene, session.flight().effects);
    last.mode = session.flight().mode;
    last.exposure_ev = session.light.ev();
    last.exposure_locked = session.light.locked();
    std::string line;
    for (const auto& [label, value] : hud_fields(last, words_in("en")))
        line += label + " " + value + "  ";
    print_message(line);
    if (session.skew.frames() > 0)
        print_message(describe(session.skew));
}

/// True if the error is a lack of memory and the governor has a level for which there may be room.
bool leaves_level(Session& session, const std::exception& error)
{
    const bool no_room = dynamic_cast<const NoRoom*>(&error) || dynamic_cast<const vk::OutOfDeviceMemoryError*>(&error);
    const std::optional<Governor>& governor = session.qualities.governor();
    return no_room && governor && session.qualities.leave(governor->level(), error.what());
}

} // namespace

int fly_exhibit(const ExhibitOptions& options)
{
    Session session{options};
    RemoteControl remote(options);
    Presenter presenter(options);
    session.pins = remote.drawn_pins();
    if (!session.pins.empty() && isatty(STDOUT_FILENO))
        print_message(session.pins); // to a person at a terminal, and never into a log
    const WaitWatch watch(wait_limit_s(session.service));
    const ExitWork last([&] {
        session.service.stops();
        session.record_replay.end(session.flight(), print_message);
        session.record_replay.close();
        session.usage.close();
    });
    DeviceLosses losses(session);
    for (;;) {
        losses.opens();
        std::optional<LimitedWait> work(
            std::in_place, "the end of the exhibit's loading", loading_limit_s); // outlives context
        std::unique_ptr<RenderContext> context;
        Loss loss;
        bool coarser = false; // the device is opened anew for a level of less memory, and nothing is wrong with it
        session.service.loads("Loads the world " + session.content.scene.filename().string() + ".", loading_limit_s);
        try {
            context
                = std::make_unique<RenderContext>(session.content.scene, device_of(options), session.qualities.spectra());
            if (losses.none())
                log_world(*context);
            {
                work->restart();
                session.service.loads(
                    "Opens the outputs of " + session.layout.file.filename().string() + ".", loading_limit_s);
                FrameLoop loop(session, remote, presenter, *context);
                work.reset();
                while (!is_over(session) && loop.fly_frame())
                    ;
                session.service.stops();
                work.emplace("the end of the exhibit's closing", loading_limit_s);
            }
            print_summary(session, context->world.scene);
            const bool same = session.record_replay.end(session.flight(), print_message);
            return !same || session.complaints || !context->device.complaints.empty() ? 1 : 0;
        } catch (const std::exception& error) {
            coarser = context && leaves_level(session, error); // else the world itself has no room
            // An exhibit that has never worked has lost nothing, except where the device itself is lost while the world
            // loads.
            if (!coarser && session.shown == 0 && losses.none() && !dynamic_cast<const vk::DeviceLostError*>(&error))
                throw;
            loss = loss_by(error);
        }
        work.emplace("the end of the lost device's closing", loading_limit_s);
        session.service.loads("Opens the GPU again.", loading_limit_s);
        session.complaints |= context && !context->device.complaints.empty();
        context.reset();
        if (coarser)
            continue;
        if (losses.flew())
            session.usage.count([](UsageCounts& counts) { ++counts.device_losses; });
        if (!losses.survives(loss))
            return 1;
        if (is_over(session))
            return session.record_replay.end(session.flight(), print_message) && !session.complaints ? 0 : 1;
    }
}

} // namespace starbow
