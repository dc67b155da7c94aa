#include "node.h"
#include "config/json/error.h"
#include "config/model/shipped.h"
#include "exhibit_renderer.h"
#include "node_layout.h"
#include "picture_setup.h"
#include "runtime/machines/frame_log.h"
#include "runtime/machines/gate.h"
#include "runtime/machines/page_bytes.h"
#include "runtime/operation/log.h"
#include "runtime/operation/waits.h"
#include "runtime/render/debug.h"
#include "runtime/render/render_context.h"
#include "screens.h"
#include "session.h"
#include "world_loader.h"
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace starbow {
namespace {

using Clock = std::chrono::steady_clock;

/// Without a state for so long, seconds, the outputs fade; they are black after the second time.
constexpr double patience_s = 0.5, fade_s = 0.4;
/// A frame waits for the master's word no longer than the master waits for the nodes.
constexpr double longest_go_s = Gate::most_wait_s;
/// A page is sent before the first state that names it, and may arrive after that.
constexpr double longest_page_s = 0.05;

class Node {
public:
    explicit Node(const ExhibitOptions& options)
        : options_(options)
        , layout_(options)
        , bus_(place_of(options.machines.value()), Bus::Role::node, write_log)
        , scene_(options.content.scene)
        , context_(scene_, device_of(options), Qualities(options).spectra())
        , screens_(context_.device, options.layout, options.node)
        , words_(options.words)
        , pictures_(std::bind_front(drawn_thumbnails, options.cache, options.words))
        , done_(context_.device.device.createFence({vk::FenceCreateFlagBits::eSignaled}))
        , commands_(context_.device.device, {*context_.device.pool, vk::CommandBufferLevel::ePrimary, 2})
        , log_(options.frame_log)
    {
        name_object(context_.device, done_, "frame done");
        name_object(context_.device, commands_[0], "frame: world");
        name_object(context_.device, commands_[1], "frame: outputs");
        make_frame(options.layout);
        bus_.know({options.machines->master});
        bus_.send(layout_.config());
    }
    ~Node() { context_.device.settle(); }
    Node(const Node&) = delete;
    Node& operator=(const Node&) = delete;

    /// One picture, or a moment without one. Returns false at the end.
    bool step(Service& service);
    long shown() const { return shown_; }
    const Device& device() const { return context_.device; }

private:
    Quality quality_of(const SharedState& shared) const;
    Quality quality() const;
    void make_frame(const Layout& layout, std::optional<PreparedLayout> prepared = {});
    void listen();
    void follow_files();
    void apply(LayoutLoader::Loaded loaded);
    void take(const StateMessage& state);
    void follow(const SharedState& shared);
    void open_world(const std::string& scene);
    double fade() const;
    bool lacks_page() const;
    void await_page();
    void draw(const SharedState& shared, bool fresh);
    void await_go(std::int64_t number);

    const ExhibitOptions& options_;
    NodeLayout layout_;
    Bus bus_;
    std::filesystem::path scene_; ///< the shown one
    std::string scene_name_; ///< as the master names it; empty: the options'
    RenderContext context_;
    WorldLoader worlds_;
    std::string coming_; ///< SharedState's
    Screens screens_;
    Words words_;
    std::string language_;
    std::unique_ptr<FrameRenderer> frame_;
    std::optional<std::pair<std::int32_t, std::string>> chosen_; ///< SharedState's level and quality; none: not yet
    PictureSetup pictures_;
    vk::raii::Fence done_;
    vk::raii::CommandBuffers commands_;
    std::optional<std::uint64_t> master_; ///< as the bus's
    std::optional<StateMessage> state_; ///< the last one
    std::optional<SharedState> shared_; ///< read from it
    bool fresh_ = false; ///< it is not drawn yet
    bool was_in_step_ = false; ///< this node has drawn one exactly
    std::int64_t page_number_ = 0; ///< of the page
    Panel page_; ///< the instruments'
    bool away_ = true; ///< the master
    bool dark_ = false; ///< the outputs are black for want of it
    Clock::time_point heard_ = Clock::now();
    std::int64_t go_ = -1; ///< the last frame that may be shown
    Skew skew_;
    std::string unread_; ///< the last complaint
    struct {
        std::string scene, why;
        Clock::time_point since;
    } unreadable_; ///< the last world that could not be opened
    FrameLog log_;
    long shown_ = 0;
};

Quality Node::quality_of(const SharedState& shared) const
{
    const Device& device = context_.device;
    if (shared.level >= 0 && std::size_t(shared.level) < options_.ladder.size())
        return within(device, options_.ladder[std::size_t(shared.level)].quality);
    if (options_.quality && shared.quality == options_.quality_name)
        return within(device, *options_.quality);
    if (!shared.quality.empty())
        return within(device, load_quality(shipped_file("qualities", shared.quality)));
    return default_quality(device, false);
}

/// The last state's, or the start's.
Quality Node::quality() const
{
    if (shared_)
        return quality_of(*shared_);
    return options_.quality ? within(context_.device, *options_.quality) : default_quality(context_.device, false);
}

/// Makes the renderer anew; the next state says its quality.
void Node::make_frame(const Layout& layout, std::optional<PreparedLayout> prepared)
{
    frame_ = exhibit_renderer(context_, layout, quality(), options_.node, std::move(prepared));
    chosen_.reset();
    pictures_.forget();
}

void Node::listen()
{
    if (bus_.follow())
        log_routes(*options_.machines);
    const std::optional<StateMessage> state = bus_.state(); // the first one says who the master is
    if (std::exchange(master_, bus_.master()) != bus_.master())
        go_ = -1, page_number_ = 0; // those of another one
    for (const ConfigMessage& config : bus_.configs())
        if (config.node == options_.machines->master)
            layout_.compare(config, was_in_step_);
    if (const std::optional<PageMessage> page = bus_.page())
        try {
            page_ = panel_of(*page), page_number_ = page->number;
        } catch (const InputError& error) {
            write_limited(LogKind::state_unread, one_line(error.what()) + "; the page before is shown");
        }
    if (const std::optional<GoMessage> go = bus_.go())
        go_ = go->frame;
    if (state)
        take(*state);
}

void Node::take(const StateMessage& state)
{
    try {
        SharedState shared = shared_state_of(state.bytes);
        follow(shared);
        shared_ = std::move(shared), state_ = state, fresh_ = true;
        heard_ = Clock::now();
        if (std::exchange(away_, false))
            write_limited(LogKind::master_back, "the master says what is shown");
        unread_.clear();
    } catch (const InputError& error) {
        if (std::exchange(unread_, one_line(error.what())) != one_line(error.what()))
            write_limited(LogKind::state_unread, unread_ + "; the last picture is shown, then none");
    }
}

/// Opens what another state needs. Throws InputError; then the old one is shown.
void Node::follow(const SharedState& shared)
{
    if (shared.scene != scene_name_) {
        const std::filesystem::path scene = shipped_file("scenes", shared.scene);
        if (scene != scene_)
            open_world(shared.scene);
        scene_name_ = shared.scene, scene_ = scene;
    }
    if (std::exchange(coming_, shared.coming) != shared.coming && !coming_.empty())
        worlds_.open(shipped_file("scenes", coming_));
    worlds_.ready(); // a newer wish follows an older one
    if (shared.language != language_) {
        words_ = shared.language == options_.words.language ? options_.words : words_in(shared.language);
        language_ = shared.language;
    }
    if (std::optional<Layout> turned = layout_.turned_by(shared)) {
        frame_->adopt(*turned);
        layout_.turn(*std::move(turned), shared.turned);
    }
    const World& world = context_.world.world;
    if (shared.picture.instruments)
        for (const auto& mark : shared.picture.instruments->marks)
            if (mark
                && (mark->frame < 0 || std::size_t(mark->frame) >= std::max<std::size_t>(world.frames.size(), 1)
                    || (mark->clock && *mark->clock >= world.instances.size())))
                throw InputError("a state of the exhibit's machines has a mark on a thing that is not in the world");
    if (const std::pair choice(shared.level, shared.quality); choice != chosen_) {
        frame_->adopt(quality_of(shared));
        chosen_ = choice;
    }
}

void Node::open_world(const std::string& scene)
{
    constexpr double again_s = 5; // each state names it
    if (scene == unreadable_.scene && seconds(Clock::now() - unreadable_.since) < again_s)
        throw InputError(unreadable_.why);
    const LimitedWait loading("the world " + scene, loading_limit_s);
    try {
        LoadedScene loaded = worlds_.take(shipped_file("scenes", scene));
        GpuWorld world = in_room([&] { return upload_scene(context_, std::move(loaded), Qualities(options_).spectra()); });
        exchange_world(context_, std::move(world), [&] { make_frame(layout_.shown()); });
    } catch (const InputError& error) {
        unreadable_ = {scene, error.what(), Clock::now()};
        throw;
    }
    log_world(context_);
}

/// Has a changed layout loaded beside, and applies one that is ready. If any file is wrong, nothing changes.
void Node::follow_files()
{
    LayoutLoader& loader = layout_.loader;
    if (loader.changed())
        loader.load({.kept = layout_.kept(),
            .layout = layout_.kept(),
            .quality = quality(),
            .sizes = screens_.sizes(),
            .has_stars = !context_.world.stars.stars.empty()});
    std::optional<LayoutLoader::Result> result = loader.result();
    if (!result)
        return;
    try {
        apply(LayoutLoader::loaded_of(*std::move(result)));
    } catch (const InputError& error) {
        write_limited(LogKind::layout_refused, one_line(error.what()) + "; the exhibit stays as it was");
    }
}

void Node::apply(LayoutLoader::Loaded loaded)
{
    const LimitedWait applying("the changed layout", loading_limit_s);
    make_frame(loaded.fresh, std::move(loaded.prepared));
    screens_.adopt(loaded.fresh);
    write_limited(LogKind::layout_applied, loaded.fresh.file.string() + ": applied");
    layout_.take(std::move(loaded));
    bus_.send(layout_.config());
    if (shared_)
        follow(*shared_);
}

/// The part of black while the master is away.
double Node::fade() const
{
    return shared_ ? std::clamp((seconds(Clock::now() - heard_) - patience_s) / fade_s, 0.0, 1.0) : 1;
}

bool Node::step(Service& service)
{
    glfwPollEvents();
    if ((options_.over && options_.over()) || screens_.closed())
        return false;
    if (options_.frames > 0 && shown_ >= options_.frames)
        return false;
    screens_.follow();
    follow_files();
    listen();
    if (fresh_)
        await_page();
    const double faded = fade();
    if (away_)
        service.waits(bus_.lack().empty() ? "Waits for the master." : "Waits for the network: " + bus_.lack() + ".");
    else
        service.shows("Shows " + std::to_string(screens_.shown()) + " outputs of the node " + options_.node + ".");
    if (!fresh_ && (faded == 0 || (faded == 1 && dark_))) {
        bus_.wait(std::chrono::milliseconds(5));
        return true;
    }
    if (faded > 0 && !std::exchange(away_, true))
        write_limited(LogKind::master_away, "no state from the master for half a second; the outputs fade to black");
    if (!screens_.acquire()) {
        bus_.wait(std::chrono::milliseconds(20));
        return true;
    }
    SharedState shared = shared_.value_or(SharedState{});
    if (shared.picture.instruments && page_number_ != 0)
        shared.picture.instruments->panel = shared.picture.instruments->panel_number != 0 ? &page_ : nullptr;
    shared.picture.fade = std::max(shared.picture.fade, glm::smoothstep(0.0, 1.0, faded));
    draw(shared, std::exchange(fresh_, false));
    dark_ = faded == 1;
    return true;
}

/// True where the state names a page that is still to come.
bool Node::lacks_page() const
{
    const auto& on = shared_ ? shared_->picture.instruments : std::nullopt;
    return on && on->panel_number != 0 && on->panel_number != page_number_;
}

void Node::await_page()
{
    for (const Clock::time_point begun = Clock::now(); lacks_page() && seconds(Clock::now() - begun) < longest_page_s;) {
        bus_.wait(std::chrono::milliseconds(5));
        listen();
    }
}

/// Only a frame that is exactly the master's counts as ready: one with another layout's file, or without its page, is not.
void Node::draw(const SharedState& shared, bool fresh)
{
    const Clock::time_point begun = Clock::now();
    Device& device = context_.device;
    const std::int64_t number = state_ ? state_->frame : -1;
    for (std::size_t i = 0; i < screens_.targets().size(); ++i)
        if (const Target& target = screens_.targets()[i]; target.view)
            frame_->resize(i, glm::ivec2(target.extent.width, target.extent.height));
    const Panel* panel = pictures_.set_up(shared.picture, words_, *frame_);
    for (vk::raii::CommandBuffer& commands : commands_) {
        commands.reset();
        commands.begin({vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
    }
    screens_.begin_pictures(*commands_[1]);
    frame_->draw(*commands_[0], *commands_[1], shared.picture.shot, panel, screens_.targets());
    screens_.end_pictures(*commands_[1]);
    for (const vk::raii::CommandBuffer& commands : commands_)
        commands.end();
    device.device.resetFences(*done_);
    screens_.submit(*commands_[0], *commands_[1], *done_);
    device.await(*done_, "the end of the frame's drawing (fence)");
    if (fresh) {
        const bool exact = layout_.is_of(shared) && !lacks_page();
        // Another digest, for the log.
        const std::uint64_t digest = digest_of_state(state_->bytes) + (exact ? 0 : 1);
        const double drawn_ms = 1e3 * seconds(Clock::now() - begun);
        if (exact) {
            bus_.send(ReadyMessage{options_.node, number, digest, drawn_ms, screens_.barrier(), frame_->own_samples()});
            was_in_step_ = true;
        }
        await_go(number);
        log_.add(number, digest, drawn_ms);
    }
    screens_.present(skew_);
    ++shown_;
}

/// Waits for the master's word on the frame that is drawn, but not past the next one's state.
void Node::await_go(std::int64_t number)
{
    const Clock::time_point begun = Clock::now();
    for (;;) {
        listen();
        const double left_s = longest_go_s - seconds(Clock::now() - begun);
        if (go_ >= number || state_->frame != number || left_s <= 0)
            return;
        bus_.wait(std::chrono::nanoseconds(std::int64_t(1e9 * left_s)));
    }
}

} // namespace

int show_node(const ExhibitOptions& options)
{
    Service service;
    const WaitWatch watch(wait_limit_s(service));
    std::unique_ptr<Node> node;
    {
        service.loads("Loads the node " + options.node + ".", loading_limit_s);
        const LimitedWait loading("the end of the node's loading", loading_limit_s);
        node = std::make_unique<Node>(options);
    }
    while (node->step(service))
        ;
    service.stops();
    return node->device().complaints.empty() ? 0 : 1;
}

} // namespace starbow
