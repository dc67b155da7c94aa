#include "exhibit.h"
#include "config/json/error.h"
#include "config/model/shipped.h"
#include "frame_loop.h"
#include "runtime/operation/log.h"
#include "runtime/operation/messages.h"
#include "runtime/operation/waits.h"
#include <cstdio>
#include <memory>
#include <thread>

namespace starbow {
namespace {

using Clock = std::chrono::steady_clock;

/// A lost GPU, as after a hang of its driver, or one that has run out of memory, is opened anew and the flight goes on.
/// After so many losses, each within a minute of the one before, the program gives up.
constexpr int most_losses = 5;

/// Prints the closing lines: the flight's last readings and the skew of the screens.
void print_summary(const Session& session, const SceneFile& scene)
{
    Readings last = readings(session.flight.ship, scene, session.flight.effects);
    last.mode = session.flight.mode;
    last.exposure_ev = ev_of(session);
    last.exposure_locked = session.exposure.locked;
    std::string line;
    for (const auto& [label, value] : hud_fields(last, words_in("en")))
        line += label + " " + value + "  ";
    print_message(line);
    if (session.skew.frames() > 0)
        print_message(describe(session.skew));
}

Device::Options device_of(const ExhibitOptions& options)
{
    Device::Options device = device_options(true);
    device.counted = options.counts_driver_memory;
    return device;
}

/// True if the error is a lack of memory and the governor has a level for which there may be room.
bool leaves_level(Session& session, const std::exception& error)
{
    const bool no_room = dynamic_cast<const NoRoom*>(&error) || dynamic_cast<const vk::OutOfDeviceMemoryError*>(&error);
    return no_room && session.governor && take_coarser_level(session, session.governor->level(), error.what());
}

} // namespace

int fly_exhibit(const ExhibitOptions& options)
{
    Session session{options};
    RemoteControl remote(options);
    const WaitWatch watch(wait_limit_s(session.service));
    for (int losses = 0;;) {
        const Clock::time_point opened = Clock::now();
        std::optional<LimitedWait> work(
            std::in_place, "the end of the exhibit's loading", loading_limit_s); // outlives context
        std::unique_ptr<RenderContext> context;
        std::string lost;
        bool coarser = false; // the device is opened anew for a level of less memory, and nothing is wrong with it
        const char* how = "is lost";
        session.service.loads("Loads the world " + session.programme.scene.filename().string() + ".", loading_limit_s);
        try {
            context
                = std::make_unique<RenderContext>(session.programme.scene, device_of(options), spectral_level_of(session));
            if (losses == 0)
                log_world(*context);
            {
                work->restart();
                session.service.loads(
                    "Opens the outputs of " + session.layout.file.filename().string() + ".", loading_limit_s);
                FrameLoop loop(session, remote, *context);
                work.reset();
                while (!is_over(session) && loop.fly_frame())
                    ;
                session.service.stops();
                work.emplace("the end of the exhibit's closing", loading_limit_s);
            }
            print_summary(session, context->world.scene);
            const bool same = session.record_replay.end(session.flight, print_message);
            return !same || session.complaints || !context->device.complaints.empty() ? 1 : 0;
        } catch (const vk::DeviceLostError& error) {
            lost = error.what();
        } catch (const vk::SystemError& error) {
            coarser = context && leaves_level(session, error); // else the world itself has no room
            if (!coarser && losses == 0 && session.shown == 0)
                throw; // it has never worked
            lost = error.what(), how = "has failed";
        } catch (const InputError& error) {
            coarser = context && leaves_level(session, error); // else the world itself has no room
            if (!coarser && losses == 0 && session.shown == 0)
                throw;
            lost = error.what(), how = "has failed"; // no memory for what is to be drawn, or the driver is not back yet
        }
        work.emplace("the end of the lost device's closing", loading_limit_s);
        session.service.loads("Opens the GPU anew.", loading_limit_s);
        session.complaints |= context && !context->device.complaints.empty();
        context.reset();
        if (coarser)
            continue;
        session.diary.count([](Tally& tally) { ++tally.device_losses; });
        if (seconds(Clock::now() - opened) > 60)
            losses = 0;
        if (++losses > most_losses) {
            log_error("exhibit", std::string("the GPU ") + how + " again and again (" + lost + ")");
            return 1;
        }
        log_warning("exhibit", std::string("the GPU ") + how + " (" + lost + "); it is opened anew");
        std::this_thread::sleep_for(std::chrono::seconds(losses - 1));
    }
}

} // namespace starbow
