#include "node.h"
#include "config/json/error.h"
#include "config/model/shipped.h"
#include "instant_pictures.h"
#include "machine_files.h"
#include "runtime/machines/frame_log.h"
#include "runtime/machines/gate.h"
#include "runtime/machines/instant_bytes.h"
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

class Node {
public:
    explicit Node(const ExhibitOptions& options)
        : options_(options)
        , config_(config_of(options))
        , bus_(options.machines.value().interface, options.machines->domain)
        , scene_(options.programme.scene)
        , context_(scene_, device_options(true), spectral_level_of(options))
        , screens_(context_.device, options.layout, options.node)
        , words_(options.words)
        , done_(context_.device.device.createFence({vk::FenceCreateFlagBits::eSignaled}))
        , commands_(context_.device.device, {*context_.device.pool, vk::CommandBufferLevel::ePrimary, 2})
        , log_(options.frame_log)
    {
        name_object(context_.device, done_, "frame done");
        name_object(context_.device, commands_[0], "frame: world");
        name_object(context_.device, commands_[1], "frame: outputs");
        make_frame();
        warn_of_routes(*options.machines);
        bus_.send(config_);
    }
    ~Node() { context_.device.settle(); }
    Node(const Node&) = delete;
    Node& operator=(const Node&) = delete;

    /// One picture, or a moment without one. Returns false at the end.
    bool step(Service& service);
    long shown() const { return shown_; }
    const Device& device() const { return context_.device; }

private:
    Quality quality_of(const SharedInstant& shared) const;
    void make_frame();
    void listen();
    void take(const StateMessage& state);
    void follow(const SharedInstant& shared);
    void open_world(const std::string& scene);
    double blackness() const;
    void draw(const SharedInstant& shared, bool fresh);
    void await_go(std::int64_t number);

    const ExhibitOptions& options_;
    ConfigMessage config_;
    Bus bus_;
    std::filesystem::path scene_; ///< the shown one
    std::string scene_name_; ///< as the master names it; empty: the options'
    RenderContext context_;
    WorldLoader worlds_;
    std::string coming_; ///< SharedInstant's
    Screens screens_;
    Words words_;
    std::string language_;
    std::unique_ptr<FrameRenderer> frame_;
    std::optional<std::pair<std::int32_t, std::string>> chosen_; ///< SharedInstant's level and quality; none: not yet
    InstantPictures pictures_;
    vk::raii::Fence done_;
    vk::raii::CommandBuffers commands_;
    std::optional<StateMessage> state_; ///< the last one
    std::optional<SharedInstant> shared_; ///< read from it
    bool fresh_ = false; ///< it is not drawn yet
    bool away_ = true; ///< the master
    bool dark_ = false; ///< the outputs are black for want of it
    Clock::time_point heard_ = Clock::now();
    std::int64_t go_ = -1; ///< the last frame that may be shown
    Skew skew_;
    std::string unread_; ///< the last complaint
    FrameLog log_;
    long shown_ = 0;
};

Quality Node::quality_of(const SharedInstant& shared) const
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

void Node::make_frame()
{
    const Quality first
        = options_.quality ? within(context_.device, *options_.quality) : default_quality(context_.device, false);
    frame_ = in_room([&] {
        return std::make_unique<FrameRenderer>(
            context_.device, context_.pipelines, context_.world, options_.layout, first, false);
    });
    chosen_.reset();
    frame_->only(options_.node);
    frame_->repeatable(true); // each machine's pictures are those of one that has drawn all before
    pictures_.forget();
}

void Node::listen()
{
    for (const ConfigMessage& config : bus_.configs())
        if (config.node == options_.machines->master)
            if (const std::string why = difference(config_, config); !why.empty())
                throw InputError(why);
    bus_.readies(); // the others'
    if (const std::optional<GoMessage> go = bus_.go())
        go_ = go->frame;
    if (const std::optional<StateMessage> state = bus_.state())
        take(*state);
}

void Node::take(const StateMessage& state)
{
    try {
        SharedInstant shared = instant_of(state.instant);
        follow(shared);
        shared_ = std::move(shared), state_ = state, fresh_ = true;
        heard_ = Clock::now();
        if (std::exchange(away_, false))
            write_log(LogKind::master_back, "the master says what is shown");
        unread_.clear();
    } catch (const InputError& error) {
        if (std::exchange(unread_, one_line(error.what())) != one_line(error.what()))
            write_log(LogKind::state_unread, unread_ + "; the last picture is shown, then none");
    }
}

/// Opens what another state needs. Throws InputError; then the old one is shown.
void Node::follow(const SharedInstant& shared)
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
    const World& world = context_.world.world;
    if (shared.instant.instruments)
        for (const auto& mark : shared.instant.instruments->marks)
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
    const LimitedWait loading("the world " + scene, loading_limit_s);
    LoadedScene loaded = worlds_.take(shipped_file("scenes", scene));
    GpuWorld world = in_room([&] { return upload_scene(context_, std::move(loaded), spectral_level_of(options_)); });
    std::swap(context_.world, world);
    make_frame();
    log_world(context_);
}

/// The part of black while the master is away.
double Node::blackness() const
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
    listen();
    const double black = blackness();
    if (away_)
        service.waits("Waits for the master.");
    else
        service.shows("Shows " + std::to_string(screens_.shown()) + " outputs of the node " + options_.node + ".");
    if (!fresh_ && (black == 0 || (black == 1 && dark_))) {
        bus_.wait(std::chrono::milliseconds(5));
        return true;
    }
    if (black > 0 && !std::exchange(away_, true))
        write_log(LogKind::master_away, "no state from the master for half a second; the outputs fade to black");
    if (!screens_.acquire()) {
        bus_.wait(std::chrono::milliseconds(20));
        return true;
    }
    SharedInstant shared = shared_.value_or(SharedInstant{});
    shared.instant.black = std::max(shared.instant.black, glm::smoothstep(0.0, 1.0, black));
    draw(shared, std::exchange(fresh_, false));
    dark_ = black == 1;
    return true;
}

void Node::draw(const SharedInstant& shared, bool fresh)
{
    const Clock::time_point begun = Clock::now();
    Device& device = context_.device;
    const std::int64_t number = state_ ? state_->frame : -1;
    for (std::size_t i = 0; i < screens_.targets().size(); ++i)
        if (const Target& target = screens_.targets()[i]; target.view)
            frame_->resize(i, glm::ivec2(target.extent.width, target.extent.height));
    const Panel* panel = pictures_.set_up(shared.instant, words_, *frame_);
    for (vk::raii::CommandBuffer& commands : commands_) {
        commands.reset();
        commands.begin({vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
    }
    screens_.begin_pictures(*commands_[1]);
    frame_->draw(*commands_[0], *commands_[1], shared.instant.shot, panel, screens_.targets());
    screens_.end_pictures(*commands_[1]);
    for (const vk::raii::CommandBuffer& commands : commands_)
        commands.end();
    device.device.resetFences(*done_);
    screens_.submit(*commands_[0], *commands_[1], *done_);
    device.await(*done_, "the end of the frame's drawing (fence)");
    if (fresh) {
        const std::uint64_t digest = digest_of_instant(state_->instant);
        const double drawn_ms = 1e3 * seconds(Clock::now() - begun);
        bus_.send(ReadyMessage{options_.node, number, digest, drawn_ms, frame_->own_samples()});
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
