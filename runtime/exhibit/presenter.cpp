#include "presenter.h"
#include "config/json/error.h"
#include "config/model/shipped.h"
#include "menu_pages.h"
#include "runtime/hud/hud.h"
#include "runtime/operation/log.h"
#include "thumbnails.h"
#include <csignal>
#include <sys/resource.h>
#include <unistd.h>

namespace starbow {
namespace {

std::vector<Cue> cues_of(const std::vector<Step>& steps)
{
    std::vector<Cue> cues;
    for (const Step& step : steps) {
        std::string text = announced(step);
        cues.push_back({text.empty() ? "–" : std::move(text), step.seconds});
    }
    return cues;
}

std::vector<std::pair<std::string, std::string>> titled(
    const Words& words, const std::string& kind, const std::vector<std::string>& names)
{
    std::vector<std::pair<std::string, std::string>> all;
    for (const std::string& name : names)
        all.emplace_back(name, words.title(kind, name));
    return all;
}

PresenterState state_of(const Session& session)
{
    PresenterState state;
    describe(session, state);
    state.own_effects = session.source->by_hand();
    if (state.steps > 0)
        state.cues = cues_of(session.tour()->steps());
    else
        state.tour.clear();
    return state;
}

} // namespace

PresenterPainter::PresenterPainter(std::function<Thumbnails()> load)
{
    // A signal is for the frame thread, and so is the processor where both need it.
    sigset_t all, before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    thread_ = std::thread([this, load = std::move(load)] {
        setpriority(PRIO_PROCESS, id_t(gettid()), 10);
        work(load);
    });
    pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

PresenterPainter::~PresenterPainter()
{
    ends_ = true;
    asked_.release();
    thread_.join();
}

void PresenterPainter::ask()
{
    orders_.publish();
    asked_.release();
}

const PresenterPicture* PresenterPainter::take() { return pictures_.refresh() ? &pictures_.newest() : nullptr; }

void PresenterPainter::work(const std::function<Thumbnails()>& load)
{
    const Typesetter typesetter; // its letters are not for two threads
    Thumbnails thumbnails;
    bool loaded = false; // once the first picture is painted: nobody waits for small ones
    for (;;) {
        asked_.acquire();
        if (ends_)
            return;
        if (!orders_.refresh())
            continue;
        const Order& order = orders_.newest();
        starbow::paint(order.sheet, order.view, thumbnails, typesetter, order.size, order.blue_first, pictures_.next());
        pictures_.publish();
        if (!std::exchange(loaded, true))
            thumbnails = load();
    }
}

Presenter::Presenter(const ExhibitOptions& options)
{
    if (!options.presenter)
        return;
    const Typesetter font; // throws here what would end the thread
    painter_ = std::make_unique<PresenterPainter>(std::bind_front(drawn_thumbnails, options.cache, options.words));
    scenes_ = shipped_names("scenes"), tours_ = shipped_names("tours"), shots_ = shipped_names("shots");
    languages_ = languages_here([](const std::string& why) {
        write_log(LogKind::words_unreadable, why + "; the guide's window leaves this language out");
    });
}

Presenter::~Presenter() = default;

void Presenter::close()
{
    closed_ = true;
    write_log(LogKind::output_missing,
        "the guide's window was closed; the exhibit goes on, and its next start opens the window again");
}

void Presenter::read(std::vector<Command>& commands)
{
    for (Command& command : given_) {
        if (command.kind != CommandKind::touch) // ten a second while the mouse is dragged
            write_log(LogKind::command_taken, text_of(command) + " from the guide's window");
        commands.push_back(std::move(command));
    }
    given_.clear();
}

void Presenter::note(const Command& command, const std::string& refusal, const Words& words)
{
    if (!painter_)
        return;
    refused_ = !refusal.empty();
    const std::string name = text_of(command);
    said_ = refused_ ? words("remote.refused", {{"command", name}, {"reason", refusal}})
                     : words("remote.done", {{"command", name}});
    pressed_ = true;
}

void Presenter::press(int key)
{
    if (size_.x == 0)
        return; // nothing is shown yet that could be meant
    if (std::optional<Command> command = starbow::press(sheet_, hands_, key)) {
        static_cast<ExhibitState&>(state_) = after(state_, *command);
        given_.push_back(std::move(*command));
    }
    sheet_ = sheet_of(state_, hands_, words_); // the next key may come before the next picture
    pressed_ = true;
}

void Presenter::point(glm::ivec2 at)
{
    const Clock::time_point now = Clock::now();
    if (now - pointed_ < std::chrono::milliseconds(100))
        return;
    const PresenterBox shown = shown_box(places_of(sheet_, size_).picture, view_.size);
    if (size_.x == 0 || !shown.holds(at))
        return;
    pointed_ = now;
    const glm::dvec2 part = (glm::dvec2(at - shown.corner) + 0.5) / glm::dvec2(shown.size);
    given_.push_back({.kind = CommandKind::touch, .number = part.x, .second = part.y});
}

void Presenter::click(glm::ivec2 at)
{
    point(at);
    if (const int key = key_at(sheet_, size_, at); key != 0 && !hands_.typed)
        press(key);
}

void Presenter::type(char32_t character)
{
    starbow::type(hands_, character);
    pressed_ = true;
}

bool Presenter::due()
{
    const Clock::time_point now = Clock::now();
    if (!pressed_ && now - painted_ < std::chrono::milliseconds(100))
        return false;
    painted_ = now;
    pressed_ = false;
    return true;
}

bool Presenter::wants_view()
{
    const Clock::time_point now = Clock::now();
    if (!seen || now - viewed_ < std::chrono::milliseconds(200))
        return false;
    viewed_ = now;
    return true;
}

void Presenter::paint(const Session& session, glm::ivec2 size, bool blue_first)
{
    state_ = state_of(session);
    if (words_.language != session.words.language)
        words_ = session.words;
    state_.said = said_, state_.refused = refused_;
    state_.scenes = titled(session.words, "scene", scenes_), state_.tours = titled(session.words, "tour", tours_);
    state_.shots = titled(session.words, "shot", shots_);
    state_.languages = languages_;
    if (session.options.programme)
        for (const ProgrammeItem& item : session.options.programme->items) {
            const auto& [kind, name] = shown_by(item);
            state_.programme.push_back({session.words.title(kind, name), said(item.notes, session.words), item.minutes});
        }
    sheet_ = sheet_of(state_, hands_, words_);
    size_ = size;
    PresenterPainter::Order& order = painter_->next();
    order.sheet = sheet_, order.view = view_, order.size = size, order.blue_first = blue_first;
    painter_->ask();
}

} // namespace starbow
