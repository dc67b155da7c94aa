#include "remote.h"
#include "config/model/shipped.h"
#include "exchange.h"
#include "server.h"
#include <csignal>
#include <sys/resource.h>
#include <thread>
#include <unistd.h>

namespace starbow {
namespace {

/// The site's file of PINs if the exhibit's file names none; empty: PINs are drawn.
std::filesystem::path pins_file(const RemoteSettings& settings)
{
    const std::filesystem::path of_site = site();
    std::error_code error;
    if (!settings.pins.empty() || of_site.empty() || !std::filesystem::exists(of_site / "pins", error))
        return settings.pins;
    return of_site / "pins";
}

} // namespace

struct Remote::Parts {
    explicit Parts(const RemoteOptions& options)
        : file(pins_file(options.settings))
        , drawn(file.empty() ? draw_pins() : Pins{})
        , server(options, file.empty() ? drawn : read_pins(file), exchange)
    {
    }

    std::filesystem::path file;
    Pins drawn;
    Exchange exchange;
    Server server;
    std::thread thread;
};

Remote::Remote(RemoteOptions options)
    : parts_(std::make_unique<Parts>(options))
{
    // A signal is for the frame thread, and so is the processor where both need it.
    sigset_t all, before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    parts_->thread = std::thread([this] {
        setpriority(PRIO_PROCESS, id_t(gettid()), 10);
        parts_->server.serve();
    });
    pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

Remote::~Remote()
{
    parts_->exchange.ends = true;
    parts_->server.wake();
    parts_->thread.join();
}

const Pins& Remote::drawn_pins() const { return parts_->drawn; }
const std::string& Remote::page() const { return parts_->server.page(); }
bool Remote::take(NumberedCommand& command) { return parts_->exchange.commands.take(command); }
void Remote::answer(std::uint64_t number, const std::string& refusal) { parts_->exchange.replies.put({number, refusal}); }
Snapshot& Remote::next_snapshot() { return parts_->exchange.snapshots.next(); }
void Remote::publish_snapshot() { parts_->exchange.snapshots.publish(); }
Condition& Remote::next_condition() { return parts_->exchange.conditions.next(); }
void Remote::publish_condition() { parts_->exchange.conditions.publish(); }
LivePicture& Remote::next_picture() { return parts_->exchange.pictures.next(); }
void Remote::publish_picture() { parts_->exchange.pictures.publish(); }
const std::string& Remote::lack()
{
    parts_->exchange.lacks.refresh();
    return parts_->exchange.lacks.newest();
}
bool Remote::picture_wanted() const { return parts_->exchange.picture_wanted.load(std::memory_order_relaxed); }

} // namespace starbow
