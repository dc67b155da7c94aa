#include "bus.h"
#include "config/json/error.h"
#include "config/json/reader.h"
#include "interface.h"
#include "sound.h"
#include <array>
#include <atomic>
#include <cstring>
#include <dds/dds.h>
#include <machines.h>
#include <mutex>
#include <set>
#include <thread>

namespace starbow {
namespace {

using Clock = std::chrono::steady_clock;
/// The log's lines about messages, and those of the engine, come at most so often: strangers must not fill it.
constexpr std::chrono::seconds between_lines{60};

/// The engine speaks on threads of its own. It is one for the whole process.
struct EngineLog {
    std::mutex mutex;
    LogTo log;
    std::string last; ///< line, for the reason of a failure
    std::optional<Clock::time_point> said;
    long left_out = 0;
};
EngineLog& engine_log()
{
    static auto& only = *new EngineLog; // the engine may speak while the program ends
    return only;
}

void engine_speaks(void*, const dds_log_data_t* data)
{
    EngineLog& engine = engine_log();
    const std::lock_guard lock(engine.mutex);
    engine.last = one_line(std::string(data->message, data->size));
    while (engine.last.ends_with(' '))
        engine.last.pop_back();
    const Clock::time_point now = Clock::now();
    if (engine.said && now - *engine.said < between_lines) {
        ++engine.left_out;
        return;
    }
    engine.said = now;
    const long left_out = std::exchange(engine.left_out, 0);
    engine.log(LogKind::machines_library,
        "DDS says: " + engine.last + (left_out > 0 ? " (" + std::to_string(left_out) + " lines before are left out)" : ""));
}

/// The settings of the engine: this interface alone, whatever the environment says. Loopback has no multicast; the nodes on
/// it are found by asking the first ports of the domain.
std::string settings_of(const NetworkInterface& interface)
{
    const bool finds_by_asking = interface.loopback || !interface.multicast;
    return "<CycloneDDS><Domain><General><Interfaces><NetworkInterface name=\"" + interface.name
        + "\"/></Interfaces><AllowMulticast>" + (finds_by_asking ? "false" : "true")
        + "</AllowMulticast></General><Discovery>"
        + (finds_by_asking ? "<Peers><Peer address=\"" + interface.address
                    + "\"/></Peers><ParticipantIndex>auto</ParticipantIndex><MaxAutoParticipantIndex>80</"
                      "MaxAutoParticipantIndex>"
                           : std::string())
        + "</Discovery></Domain></CycloneDDS>";
}

dds_entity_t made(dds_entity_t entity, const char* what)
{
    if (entity >= 0)
        return entity;
    EngineLog& engine = engine_log();
    const std::lock_guard lock(engine.mutex);
    throw InputError(std::string(what) + ": " + dds_strretcode(-entity) + (engine.last.empty() ? "" : ", " + engine.last));
}

enum class Keeps { nothing, last };
enum class Way { out, in, both };

using Qos = std::unique_ptr<dds_qos_t, void (*)(dds_qos_t*)>;

/// Reliable; of each node the last `depth` samples count. keeps: for those that join late. Nobody hears itself.
Qos qos(Keeps keeps, int depth)
{
    Qos made(dds_create_qos(), dds_delete_qos);
    dds_qset_reliability(made.get(), DDS_RELIABILITY_RELIABLE, DDS_MSECS(2));
    dds_qset_history(made.get(), DDS_HISTORY_KEEP_LAST, depth);
    dds_qset_durability(made.get(), keeps == Keeps::last ? DDS_DURABILITY_TRANSIENT_LOCAL : DDS_DURABILITY_VOLATILE);
    dds_qset_ignorelocal(made.get(), DDS_IGNORELOCAL_PARTICIPANT);
    return made;
}

const char* text(const char* from) { return from ? from : ""; }

/// The address of a string that a sample only reads.
char* lent(const std::string& from) { return const_cast<char*>(from.c_str()); }

} // namespace

namespace bus_doors { // of members of Bus, which no unnamed namespace may have

/// The participant that a writer belongs to: a run of a program.
using Participant = std::array<std::uint8_t, 16>;
inline std::optional<Participant> participant_of(dds_entity_t reader, dds_instance_handle_t writer)
{
    dds_builtintopic_endpoint_t* const about = dds_get_matched_publication_data(reader, writer);
    if (!about)
        return {};
    Participant participant;
    static_assert(sizeof participant == sizeof about->participant_key.v);
    std::memcpy(participant.data(), about->participant_key.v, sizeof participant);
    dds_builtintopic_free_endpoint(about);
    return participant;
}

/// The messages that were left out, and why the first of them was.
class Refusals {
public:
    template <class Why> void add(const Why& why)
    {
        const std::lock_guard lock(mutex_);
        if (count_++ == 0)
            first_ = why();
    }
    std::pair<long, std::string> take()
    {
        const std::lock_guard lock(mutex_);
        return {std::exchange(count_, 0), std::exchange(first_, {})};
    }

private:
    std::mutex mutex_;
    long count_ = 0;
    std::string first_;
};

/// The names of nodes that are let in. Any other name would take memory for ever, as each is a key of its topic.
class Names {
public:
    explicit Names(std::size_t most_strangers)
        : most_strangers_(most_strangers)
    {
    }
    void know(const std::vector<std::string>& names)
    {
        const std::lock_guard lock(mutex_);
        known_ = {names.begin(), names.end()};
    }
    bool knows(const std::string& name)
    {
        const std::lock_guard lock(mutex_);
        return known_.contains(name);
    }
    bool let_in(const char* name)
    {
        const std::lock_guard lock(mutex_);
        if (known_.contains(name) || strangers_.contains(name))
            return true;
        if (strangers_.size() >= most_strangers_)
            return false;
        strangers_.insert(name);
        return true;
    }

private:
    std::mutex mutex_;
    std::size_t most_strangers_;
    std::set<std::string> known_, strangers_;
};

/// A reader's filter. The threads that receive ask it before a message takes the place of another one.
struct Door {
    const std::string& exhibit;
    Refusals& refusals;
    Names* names; ///< of nodes; null: the messages have none
    std::atomic<dds_instance_handle_t> only{0}; ///< the writer that is heard; 0: any
    Names* masters = nullptr; ///< the followed master's name, where nodes write such messages as well: another writer is
                              ///< then no second master, but for one with its name

    void refuse_another(const std::string& name) const
    {
        if (!masters || masters->knows(name))
            refusals.add([] { return "comes from a second master of this exhibit; one master is right"; });
    }
};

template <class Sample> bool lets_in(const void* message, const dds_sample_info_t* info, void* door_of_reader)
{
    const Sample& sample = *static_cast<const Sample*>(message);
    Door& door = *static_cast<Door*>(door_of_reader);
    const char* const exhibit = text(sample.exhibit);
    if (exhibit != door.exhibit) {
        door.refusals.add([&] {
            return "is of another exhibit, '" + one_line(exhibit, 60) + "', and this one is '" + door.exhibit
                + "'; another domain for one of them is right";
        });
        return false;
    }
    const dds_instance_handle_t only = door.only;
    if (only != 0 && info->publication_handle != only) {
        if constexpr (requires { sample.node; })
            door.refuse_another(text(sample.node));
        else
            door.refuse_another({});
        return false;
    }
    if constexpr (requires { sample.node; })
        if (!door.names->let_in(text(sample.node))) {
            door.refusals.add(
                [&] { return "comes from node '" + one_line(text(sample.node), 60) + "', which the layout lacks"; });
            return false;
        }
    return true;
}

} // namespace bus_doors

using namespace bus_doors;

/// A layout that comes later may have a few nodes that the present one lacks.
struct Bus::Doors {
    std::string exhibit;
    Refusals refusals{};
    Names with_files{16}, ready_ones{0}, masters{0};
    Door state{exhibit, refusals, nullptr}, ready{exhibit, refusals, &ready_ones}, go{exhibit, refusals, nullptr},
        config{exhibit, refusals, &with_files}, page{exhibit, refusals, nullptr};
    std::optional<Participant> master{}; ///< that is followed

    explicit Doors(std::string own)
        : exhibit(std::move(own))
    {
        config.masters = &masters;
    }
    void refuse(const char* what, const std::string& fault)
    {
        refusals.add([&] { return std::string(what) + " " + fault + "; the same program on all machines is right"; });
    }
    /// Hears any master again.
    void open_all()
    {
        master.reset();
        for (Door* door : {&state, &go, &config, &page})
            door->only = 0;
    }
    /// True where a writer belongs to the followed master. From then on the door lets no other in.
    bool is_masters(Door& door, dds_entity_t reader, dds_instance_handle_t writer, const std::string& name = {})
    {
        if (door.only == writer)
            return true;
        if (!master || participant_of(reader, writer) != master) {
            door.refuse_another(name);
            return false;
        }
        door.only = writer;
        return true;
    }
};

struct Bus::Topics {
    struct Domain {
        dds_entity_t entity;
        ~Domain() { dds_delete(entity); } // and all in it
    };

    struct Topic {
        dds_entity_t writer = 0, reader = 0;

        Topic(dds_entity_t participant, const dds_topic_descriptor_t& type, const char* name, Keeps keeps, int depth,
            Way way, dds_topic_filter_sample_sampleinfo_arg_fn filter, Door& door)
        {
            const Qos rules = qos(keeps, depth);
            // A filter would hold for a writer of the same topic, too.
            const auto topic = [&] { return made(dds_create_topic(participant, &type, name, rules.get(), nullptr), name); };
            if (way != Way::in)
                writer = made(dds_create_writer(participant, topic(), rules.get(), nullptr), name);
            if (way == Way::out)
                return;
            const dds_entity_t filtered = topic();
            const dds_topic_filter rule{DDS_TOPIC_FILTER_SAMPLE_SAMPLEINFO_ARG, {.sample_sampleinfo_arg = filter}, &door};
            made(dds_set_topic_filter_extended(filtered, &rule), name);
            reader = made(dds_create_reader(participant, filtered, rules.get(), nullptr), name);
        }

        /// A message that can't be sent now is followed by the next one.
        template <class Sample> void write(const Sample& sample) const { dds_write(writer, &sample); }

        /// Takes all samples that have come.
        template <class Sample, class Use> void take(const Use& use) const
        {
            if (reader == 0)
                return;
            constexpr int most = 32;
            for (int count = most; count == most;) {
                void* samples[most] = {};
                dds_sample_info_t infos[most];
                count = dds_take(reader, samples, infos, most, most);
                for (int i = 0; i < count; ++i)
                    if (infos[i].valid_data)
                        use(*static_cast<const Sample*>(samples[i]), infos[i].publication_handle);
                if (count > 0)
                    dds_return_loan(reader, samples, count);
            }
        }
    };

    Domain domain;
    dds_entity_t participant;
    Topic state, ready, go, config, page;
    dds_entity_t arrivals;

    // Several masters may have sent what is kept for those that join late: hence depths above 1.
    Topics(const NetworkInterface& interface, int number, Role role, Doors& doors)
        : domain{made(dds_create_domain(dds_domainid_t(number), settings_of(interface).c_str()), "the domain")}
        , participant(made(dds_create_participant(dds_domainid_t(number), nullptr, nullptr), "the participant"))
        , state(participant, starbow_machines_State_desc, "starbow_state", Keeps::last, 1,
              role == Role::master ? Way::both : Way::in, lets_in<starbow_machines_State>, doors.state)
        , ready(participant, starbow_machines_Ready_desc, "starbow_ready", Keeps::nothing, 4,
              role == Role::master ? Way::in : Way::out, lets_in<starbow_machines_Ready>, doors.ready)
        , go(participant, starbow_machines_Go_desc, "starbow_go", Keeps::nothing, 1, from_master(role),
              lets_in<starbow_machines_Go>, doors.go)
        , config(participant, starbow_machines_Config_desc, "starbow_config", Keeps::last, 4, Way::both,
              lets_in<starbow_machines_Config>, doors.config)
        , page(participant, starbow_machines_Page_desc, "starbow_page", Keeps::last, 2, from_master(role),
              lets_in<starbow_machines_Page>, doors.page)
        , arrivals(made(dds_create_waitset(participant), "the wait"))
    {
        for (const Topic* topic : {&state, &ready, &go, &config, &page}) {
            if (topic->reader == 0)
                continue;
            const dds_entity_t condition = made(dds_create_readcondition(topic->reader, DDS_ANY_STATE), "the wait");
            dds_waitset_attach(arrivals, condition, 0);
        }
    }
    Topics(const Topics&) = delete;
    Topics& operator=(const Topics&) = delete;

    static Way from_master(Role role) { return role == Role::master ? Way::out : Way::in; }
};

Bus::Bus(BusPlace place, Role role, LogTo log)
    : place_(std::move(place))
    , role_(role)
    , log_(log)
    , awaited_("the network of the exhibit's machines", std::move(log))
    , doors_(std::make_unique<Doors>(place_.exhibit))
{
    try {
        interface_of(place_.interface);
    } catch (const NoInterface&) { // it may come
    }
    EngineLog& engine = engine_log();
    const std::lock_guard lock(engine.mutex);
    engine.log = log_;
    dds_set_log_sink(engine_speaks, nullptr);
}

Bus::~Bus() = default;
Bus::Bus(Bus&&) noexcept = default;

void Bus::know(const std::vector<std::string>& nodes) { doors_->with_files.know(nodes), doors_->ready_ones.know(nodes); }

bool Bus::follow()
{
    const Clock::time_point now = Clock::now();
    report(now);
    if (!awaited_.is_there()) {
        if (awaited_.is_due(now))
            open(now);
        return awaited_.is_there();
    }
    if (looked_ && now - *looked_ < std::chrono::seconds(1))
        return false;
    looked_ = now;
    try {
        interface_of(place_.interface);
    } catch (const InputError& error) { // what is open stays open, and is opened again once the interface is back
        awaited_.fails(error.what(), now);
    }
    return false;
}

void Bus::open(Clock::time_point now)
{
    try {
        const NetworkInterface interface = interface_of(place_.interface);
        topics_.reset();
        following_ = {}, doors_->open_all();
        topics_ = std::make_unique<Topics>(interface, place_.domain, role_, *doors_);
    } catch (const InputError& error) {
        return awaited_.fails(error.what(), now);
    }
    awaited_.comes();
    if (config_)
        send(ConfigMessage(*config_));
    if (page_)
        send(PageMessage(*page_));
}

void Bus::report(Clock::time_point now)
{
    if (reported_ && now - *reported_ < between_lines)
        return;
    const auto [count, first] = doors_->refusals.take();
    if (count == 0)
        return;
    reported_ = now;
    log_(LogKind::messages_refused,
        (count == 1 ? "a message is left out: it " : std::to_string(count) + " messages are left out; the first one ")
            + first);
}

void Bus::send(const StateMessage& state)
{
    if (!topics_)
        return;
    starbow_machines_State sample{};
    sample.frame = state.frame;
    sample.instant._buffer = const_cast<std::uint8_t*>(state.bytes.data());
    sample.instant._length = sample.instant._maximum = std::uint32_t(state.bytes.size());
    sample.exhibit = lent(place_.exhibit);
    sample.master = state.master, sample.led_ms = state.led_ms;
    topics_->state.write(sample);
}

void Bus::send(const ReadyMessage& ready)
{
    if (!topics_)
        return;
    // A sample is two floats.
    static_assert(sizeof(LuminanceSample) == 2 * sizeof(float));
    const auto put = [](dds_sequence_float& to, const std::vector<LuminanceSample>& from) {
        to._buffer = const_cast<float*>(reinterpret_cast<const float*>(from.data()));
        to._length = to._maximum = std::uint32_t(2 * from.size());
    };
    std::vector<starbow_machines_Samples> samples;
    for (const ViewSamples& view : ready.samples) {
        starbow_machines_Samples& sample = samples.emplace_back();
        sample.view = view.view;
        put(sample.surfaces, view.surfaces), put(sample.stars, view.stars);
    }
    starbow_machines_Ready sample{};
    sample.node = lent(ready.node);
    sample.frame = ready.frame, sample.digest = ready.digest, sample.frame_ms = ready.frame_ms;
    sample.barrier = ready.barrier;
    sample.samples._buffer = samples.data();
    sample.samples._length = sample.samples._maximum = std::uint32_t(samples.size());
    sample.exhibit = lent(place_.exhibit);
    topics_->ready.write(sample);
}

void Bus::send(const GoMessage& go)
{
    if (!topics_)
        return;
    std::vector<char*> members;
    for (const std::string& member : go.members)
        members.push_back(lent(member));
    starbow_machines_Go sample{};
    sample.frame = go.frame;
    sample.members._buffer = members.data();
    sample.members._length = sample.members._maximum = std::uint32_t(members.size());
    sample.exhibit = lent(place_.exhibit);
    topics_->go.write(sample);
}

void Bus::send(const ConfigMessage& config)
{
    config_ = config;
    if (!topics_)
        return;
    starbow_machines_Config sample{};
    sample.node = lent(config.node);
    std::vector<starbow_machines_File> files, layout;
    const auto put = [](auto& to, std::vector<starbow_machines_File>& held, const FileDigests& from) {
        for (const auto& [name, digest] : from)
            held.push_back({lent(name), lent(digest)});
        to._buffer = held.data();
        to._length = to._maximum = std::uint32_t(held.size());
    };
    put(sample.files, files, config.files), put(sample.layout, layout, config.layout);
    sample.exhibit = lent(place_.exhibit);
    topics_->config.write(sample);
}

void Bus::send(const PageMessage& page)
{
    page_ = page;
    if (!topics_)
        return;
    starbow_machines_Page sample{};
    sample.number = page.number, sample.width = page.width, sample.height = page.height;
    sample.texels._buffer = const_cast<std::uint8_t*>(page.texels.data());
    sample.texels._length = sample.texels._maximum = std::uint32_t(page.texels.size());
    sample.exhibit = lent(place_.exhibit);
    topics_->page.write(sample);
}

void Bus::drop_gone(Clock::time_point now)
{
    const std::optional<std::uint64_t> master = following_.master();
    if (!master || !following_.drops(!participant_of(topics_->state.reader, *master), now))
        return;
    doors_->open_all();
    frame_ = -1;
}

std::optional<StateMessage> Bus::state()
{
    std::optional<StateMessage> last;
    if (!topics_)
        return last;
    const Clock::time_point now = Clock::now();
    drop_gone(now);
    topics_->state.take<starbow_machines_State>([&](const starbow_machines_State& sample, dds_instance_handle_t writer) {
        const std::uint8_t* bytes = sample.instant._buffer;
        StateMessage state{sample.frame, {bytes, bytes + sample.instant._length}, sample.master, sample.led_ms};
        if (const std::string fault = fault_of(state); !fault.empty())
            return doors_->refuse("is a state that", fault);
        if (role_ == Role::node) {
            if (!following_.hears(writer, now))
                return; // it came before this one was chosen
            if (doors_->state.only != writer) {
                doors_->state.only = writer;
                doors_->master = participant_of(topics_->state.reader, writer);
            }
            if (state.frame <= frame_)
                return doors_->refuse("is a state that", "has a frame before the last one");
            frame_ = state.frame;
        }
        last = std::move(state);
    });
    return last;
}

std::optional<GoMessage> Bus::go()
{
    std::optional<GoMessage> last;
    if (!topics_ || !following_.master())
        return last;
    topics_->go.take<starbow_machines_Go>([&](const starbow_machines_Go& sample, dds_instance_handle_t writer) {
        if (!doors_->is_masters(doors_->go, topics_->go.reader, writer))
            return;
        GoMessage go{sample.frame, {}};
        for (std::uint32_t i = 0; i < sample.members._length; ++i)
            go.members.emplace_back(text(sample.members._buffer[i]));
        std::string fault = fault_of(go);
        constexpr int ahead = 1000; // frames; a go may overtake some states, and no more
        if (fault.empty() && go.frame > frame_ + ahead)
            fault = "is of a frame far ahead";
        if (!fault.empty())
            return doors_->refuse("is a go that", fault);
        last = std::move(go);
    });
    return last;
}

std::vector<ReadyMessage> Bus::readies()
{
    std::vector<ReadyMessage> all;
    if (!topics_)
        return all;
    topics_->ready.take<starbow_machines_Ready>([&](const starbow_machines_Ready& sample, dds_instance_handle_t writer) {
        ReadyMessage ready{text(sample.node), sample.frame, sample.digest, sample.frame_ms, sample.barrier};
        const auto taken = [](const dds_sequence_float& from) {
            std::vector<LuminanceSample> to(from._length / 2);
            if (!to.empty())
                std::memcpy(to.data(), from._buffer, to.size() * sizeof(LuminanceSample));
            return to;
        };
        for (std::uint32_t i = 0; i < sample.samples._length; ++i) {
            const starbow_machines_Samples& view = sample.samples._buffer[i];
            ready.samples.push_back({view.view, taken(view.surfaces), taken(view.stars)});
        }
        if (const std::string fault = fault_of(ready); !fault.empty())
            return doors_->refuse("is a node's word that", fault);
        ready.sender = writer;
        all.push_back(std::move(ready));
    });
    return all;
}

std::vector<ConfigMessage> Bus::configs()
{
    std::vector<ConfigMessage> all;
    if (!topics_ || (role_ == Role::node && !following_.master()))
        return all;
    topics_->config.take<starbow_machines_Config>([&](const starbow_machines_Config& sample, dds_instance_handle_t writer) {
        if (role_ == Role::node) {
            if (!doors_->is_masters(doors_->config, topics_->config.reader, writer, text(sample.node)))
                return;
            doors_->masters.know({text(sample.node)});
        }
        const auto taken = [](const auto& from) {
            FileDigests to;
            for (std::uint32_t i = 0; i < from._length; ++i)
                to.emplace_back(text(from._buffer[i].name), text(from._buffer[i].digest));
            return to;
        };
        ConfigMessage config{text(sample.node), taken(sample.files), taken(sample.layout)};
        if (const std::string fault = fault_of(config); !fault.empty())
            return doors_->refuse("is a list of files that", fault);
        all.push_back(std::move(config));
    });
    return all;
}

std::optional<PageMessage> Bus::page()
{
    std::optional<PageMessage> last;
    if (!topics_ || !following_.master())
        return last;
    topics_->page.take<starbow_machines_Page>([&](const starbow_machines_Page& sample, dds_instance_handle_t writer) {
        if (!doors_->is_masters(doors_->page, topics_->page.reader, writer))
            return;
        const std::uint8_t* bytes = sample.texels._buffer;
        PageMessage page{sample.number, sample.width, sample.height, {bytes, bytes + sample.texels._length}};
        if (const std::string fault = fault_of(page); !fault.empty())
            return doors_->refuse("is a page that", fault);
        last = std::move(page);
    });
    return last;
}

void Bus::wait(std::chrono::nanoseconds longest)
{
    constexpr std::chrono::milliseconds pause{5};
    // Messages that come before a node's first state are not taken yet, and would end each wait at once.
    if (!topics_ || (role_ == Role::node && !following_.master()))
        return std::this_thread::sleep_for(std::min<std::chrono::nanoseconds>(longest, pause));
    dds_attach_t condition;
    dds_waitset_wait(topics_->arrivals, &condition, 1, longest.count());
}

} // namespace starbow
