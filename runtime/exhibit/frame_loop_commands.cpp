// The commands of a docent that need the device; session_commands.h has the others.
#include "config/json/error.h"
#include "config/json/reader.h"
#include "config/model/angles.h"
#include "config/model/shipped.h"
#include "exhibit_renderer.h"
#include "frame_loop.h"
#include "menu_pages.h"
#include "runtime/operation/log.h"
#include "runtime/operation/vitals.h"
#include "runtime/operation/waits.h"
#include "session_commands.h"
#include <utility>

namespace starbow {

void FrameLoop::aim_pointer(std::vector<Command>& commands) const
{
    const ViewSet& views = frame_->views();
    for (Command& command : commands) {
        if (command.kind != CommandKind::touch || live_output_ >= views.outputs.size())
            continue;
        const glm::dvec2 pixel = glm::dvec2(command.number, command.second) * glm::dvec2(views.outputs[live_output_].size);
        if (const std::optional<glm::dvec3> towards = views.direction(live_output_, pixel)) { // else it is refused
            const glm::dvec2 angles = azimuth_elevation_deg(*towards);
            command = {.kind = CommandKind::pointer, .number = angles.x, .second = angles.y};
        }
    }
}

void FrameLoop::add_items_content(std::vector<Command>& commands) const
{
    const std::optional<Programme>& programme = session_.options.programme;
    for (std::size_t i = 0, count = commands.size(); i < count; ++i) {
        const double number = commands[i].number;
        if (commands[i].kind != CommandKind::item || !is_item(programme, number))
            continue; // it is refused where it is carried out
        const auto& [kind, name] = shown_by(programme->items[std::size_t(number) - 1]);
        commands.push_back(command_of(std::vector{kind, name}));
    }
}

void FrameLoop::choose_in_menu(RecordEntry& entry, Requests& requests)
{
    if (!session_.attendance.in_hand()) {
        session_.menu = {};
        return;
    }
    if (entry.controls[Switch::menu] && !session_.menu.open) // a site's own words may be wrong; the remote's page says so
        session_.languages = languages_here([](const std::string&) {});
    session_.sky_has_names = !context_.world.sky_names.stars.empty();
    session_.sky_has_sun = context_.world.scene.globes.has_value();
    if (session_.menu.open || entry.controls[Switch::menu])
        if (std::optional<Command> chosen = advance(session_.menu, menu_of(session_), entry.controls, entry.dt_ns, requests))
            entry.commands.push_back(std::move(*chosen));
}

void FrameLoop::await_worlds(std::vector<Command>& commands)
{
    // Frames that follow no clock have nobody who watches meanwhile.
    for (std::size_t i = 0; session_.options.paced && i < commands.size();) {
        const Command& command = commands[i];
        const bool leads
            = command.kind == CommandKind::scene || command.kind == CommandKind::shot || command.kind == CommandKind::tour;
        std::filesystem::path scene;
        try {
            scene = leads ? content_after(session_, command).scene : "";
        } catch (const InputError&) { // it is refused where it is carried out
        }
        if (scene.empty() || scene == session_.content.scene) {
            ++i;
            continue;
        }
        worlds_.open(scene);
        coming_ = command;
        session_.coming = scene.stem();
        remote_.defer(i);
        commands.erase(commands.begin() + std::ptrdiff_t(i));
    }
    if (!coming_ || !worlds_.ready())
        return;
    commands.push_back(std::move(*coming_));
    coming_.reset();
    session_.coming.clear();
    remote_.resume();
}

void FrameLoop::forget_coming()
{
    coming_.reset();
    session_.coming.clear();
    remote_.resume("the exhibit began again meanwhile");
}

/// Shows other content, in its world, from the start. Throws InputError, for want of memory, too; then the old world is
/// still shown.
void FrameLoop::show_content(SessionContent content, bool visitors)
{
    if (content.scene != session_.content.scene) {
        const LimitedWait loading("the world " + content.scene.filename().string(), loading_limit_s);
        session_.service.loads("Loads the world " + content.scene.filename().string() + ".", loading_limit_s);
        LoadedScene loaded = worlds_.take(content.scene);
        GpuWorld world = in_room([&] { return upload_scene(context_, std::move(loaded), session_.qualities.spectra()); });
        forget_drawn(); // it draws the old world
        exchange_world(context_, std::move(world), [&] {
            frame_ = exhibit_renderer(context_, session_.layout, session_.qualities.next(device_), session_.options.node);
        });
        log_world(context_);
        fresh_ = true; // the first frame of a world is a part of its loading
    }
    begin_content(session_, std::move(content), visitors);
    return_free_memory(); // nobody sees a pause here
}

/// Shows a fixed quality, in the governor's place.
void FrameLoop::show_quality(const std::string& name)
{
    const Quality quality = load_quality(shipped_file("qualities", name));
    frame_->adopt(within(device_, quality));
    forget_drawn();
    session_.qualities.fix(quality, name);
}

void FrameLoop::apply_command(const Command& command, Requests& requests)
{
    const std::string words = text_of(command);
    try {
        switch (command.kind) {
        case CommandKind::reset:
            forget_coming();
            forget_directions(session_);
            frame_->adopt(session_.qualities.next(device_));
            show_content(session_.options.content);
            session_.lab.reset();
            session_.alignment.show_first();
            if (const std::int64_t touched_ns = session_.attendance.visit().touched_ns; touched_ns > 0)
                count_visit(session_, 1e-9 * double(touched_ns));
            session_.attendance.begin();
            break;
        case CommandKind::scene:
        case CommandKind::shot:
        case CommandKind::tour:
            show_content(content_after(session_, command));
            if (!session_.attendance.in_hand())
                session_.attendance.begin(); // by the docent
            break;
        case CommandKind::layout:
            session_.loader.open(load_layout(shipped_file("layouts", command.text)).file);
            break;
        case CommandKind::quality:
            show_quality(command.text);
            break;
        default:
            starbow::apply_command(session_, command, requests);
        }
        remote_.note("");
        if (command.kind == CommandKind::pointer)
            return; // ten a second while a finger moves: nobody reads, or counts, these
        session_.usage.count([](UsageCounts& counts) { ++counts.commands; });
        presenter_.note(command, "", session_.words);
        write_log(LogKind::command_done, words);
    } catch (const vk::SystemError&) {
        remote_.note("the GPU was lost meanwhile; the same command again is right");
        throw; // a loss; a lack of memory is none, and a NoRoom
    } catch (const std::exception& error) {
        session_.usage.count([](UsageCounts& counts) { ++counts.refused_commands; });
        session_.docent.refusal = one_line(error.what());
        remote_.note(session_.docent.refusal);
        presenter_.note(command, session_.docent.refusal, session_.words);
        write_log(LogKind::command_failed, words + ": " + session_.docent.refusal + "; the exhibit stays as it was");
    }
}

} // namespace starbow
