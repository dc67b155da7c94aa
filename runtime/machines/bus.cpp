#include "bus.h"
#include "config/json/error.h"
#include "interface.h"
#include <cstring>
#include <dds/dds.h>
#include <machines.h>

namespace starbow {
namespace {

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
    if (entity < 0)
        throw InputError(std::string("The network of the exhibit's machines can't be opened: ") + what + ": "
            + dds_strretcode(-entity) + "; a free domain and an interface that is up are right");
    return entity;
}

enum class Keeps { nothing, last };
enum class Way { out, in, both };

/// Reliable; of each node the last `depth` samples count. keeps: for those that join late.
std::unique_ptr<dds_qos_t, void (*)(dds_qos_t*)> qos(Keeps keeps, int depth)
{
    std::unique_ptr<dds_qos_t, void (*)(dds_qos_t*)> made(dds_create_qos(), dds_delete_qos);
    dds_qset_reliability(made.get(), DDS_RELIABILITY_RELIABLE, DDS_MSECS(2));
    dds_qset_history(made.get(), DDS_HISTORY_KEEP_LAST, depth);
    dds_qset_durability(made.get(), keeps == Keeps::last ? DDS_DURABILITY_TRANSIENT_LOCAL : DDS_DURABILITY_VOLATILE);
    return made;
}

std::string text(const char* from) { return from ? from : ""; }

/// The address of a string that a sample only reads.
char* lent(const std::string& from) { return const_cast<char*>(from.c_str()); }

} // namespace

struct Bus::Topics {
    struct Topic {
        dds_entity_t writer = 0, reader = 0;

        Topic(
            dds_entity_t participant, const dds_topic_descriptor_t& type, const char* name, Keeps keeps, int depth, Way way)
        {
            const auto rules = qos(keeps, depth);
            const dds_entity_t topic = made(dds_create_topic(participant, &type, name, rules.get(), nullptr), name);
            if (way != Way::in)
                writer = made(dds_create_writer(participant, topic, rules.get(), nullptr), name);
            if (way != Way::out)
                reader = made(dds_create_reader(participant, topic, rules.get(), nullptr), name);
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
                        use(*static_cast<const Sample*>(samples[i]));
                if (count > 0)
                    dds_return_loan(reader, samples, count);
            }
        }
    };

    dds_entity_t domain, participant;
    Topic state, ready, go, config, page;
    dds_entity_t arrivals;

    Topics(const NetworkInterface& interface, int number, Role role)
        : domain(made(dds_create_domain(dds_domainid_t(number), settings_of(interface).c_str()), "the domain"))
        , participant(made(dds_create_participant(dds_domainid_t(number), nullptr, nullptr), "the participant"))
        , state(participant, starbow_machines_State_desc, "starbow_state", Keeps::last, 1, from_master(role))
        , ready(participant, starbow_machines_Ready_desc, "starbow_ready", Keeps::nothing, 4, to_master(role))
        , go(participant, starbow_machines_Go_desc, "starbow_go", Keeps::nothing, 1, from_master(role))
        , config(participant, starbow_machines_Config_desc, "starbow_config", Keeps::last, 1, Way::both)
        , page(participant, starbow_machines_Page_desc, "starbow_page", Keeps::last, 1, from_master(role))
        , arrivals(made(dds_create_waitset(participant), "the wait"))
    {
        for (const Topic* topic : {&state, &ready, &go, &config, &page}) {
            if (topic->reader == 0)
                continue;
            const dds_entity_t condition = made(dds_create_readcondition(topic->reader, DDS_ANY_STATE), "the wait");
            dds_waitset_attach(arrivals, condition, 0);
        }
    }
    ~Topics() { dds_delete(domain); } // and all in it
    Topics(const Topics&) = delete;
    Topics& operator=(const Topics&) = delete;

    static Way from_master(Role role) { return role == Role::master ? Way::out : Way::in; }
    static Way to_master(Role role) { return role == Role::master ? Way::in : Way::out; }
};

Bus::Bus(const std::string& interface, int domain, Role role)
    : topics_(std::make_unique<Topics>(interface_of(interface), domain, role))
{
}

Bus::~Bus() = default;

void Bus::send(const StateMessage& state)
{
    starbow_machines_State sample{};
    sample.frame = state.frame;
    sample.instant._buffer = const_cast<std::uint8_t*>(state.instant.data());
    sample.instant._length = sample.instant._maximum = std::uint32_t(state.instant.size());
    topics_->state.write(sample);
}

void Bus::send(const ReadyMessage& ready)
{
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
    topics_->ready.write(sample);
}

void Bus::send(const GoMessage& go)
{
    std::vector<char*> members;
    for (const std::string& member : go.members)
        members.push_back(lent(member));
    starbow_machines_Go sample{};
    sample.frame = go.frame;
    sample.members._buffer = members.data();
    sample.members._length = sample.members._maximum = std::uint32_t(members.size());
    topics_->go.write(sample);
}

void Bus::send(const ConfigMessage& config)
{
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
    topics_->config.write(sample);
}

void Bus::send(const PageMessage& page)
{
    starbow_machines_Page sample{};
    sample.number = page.number, sample.width = page.width, sample.height = page.height;
    sample.texels._buffer = const_cast<std::uint8_t*>(page.texels.data());
    sample.texels._length = sample.texels._maximum = std::uint32_t(page.texels.size());
    topics_->page.write(sample);
}

std::optional<StateMessage> Bus::state()
{
    std::optional<StateMessage> last;
    topics_->state.take<starbow_machines_State>([&](const starbow_machines_State& sample) {
        const std::uint8_t* bytes = sample.instant._buffer;
        last = {sample.frame, {bytes, bytes + sample.instant._length}};
    });
    return last;
}

std::optional<GoMessage> Bus::go()
{
    std::optional<GoMessage> last;
    topics_->go.take<starbow_machines_Go>([&](const starbow_machines_Go& sample) {
        last = {sample.frame, {}};
        for (std::uint32_t i = 0; i < sample.members._length; ++i)
            last->members.push_back(text(sample.members._buffer[i]));
    });
    return last;
}

std::vector<ReadyMessage> Bus::readies()
{
    std::vector<ReadyMessage> all;
    topics_->ready.take<starbow_machines_Ready>([&](const starbow_machines_Ready& sample) {
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
        all.push_back(std::move(ready));
    });
    return all;
}

std::vector<ConfigMessage> Bus::configs()
{
    std::vector<ConfigMessage> all;
    topics_->config.take<starbow_machines_Config>([&](const starbow_machines_Config& sample) {
        const auto taken = [](const auto& from) {
            FileDigests to;
            for (std::uint32_t i = 0; i < from._length; ++i)
                to.emplace_back(text(from._buffer[i].name), text(from._buffer[i].digest));
            return to;
        };
        all.push_back({text(sample.node), taken(sample.files), taken(sample.layout)});
    });
    return all;
}

std::optional<PageMessage> Bus::page()
{
    std::optional<PageMessage> last;
    topics_->page.take<starbow_machines_Page>([&](const starbow_machines_Page& sample) {
        const std::uint8_t* bytes = sample.texels._buffer;
        last = {sample.number, sample.width, sample.height, {bytes, bytes + sample.texels._length}};
    });
    return last;
}

void Bus::wait(std::chrono::nanoseconds longest)
{
    dds_attach_t condition;
    dds_waitset_wait(topics_->arrivals, &condition, 1, longest.count());
}

} // namespace starbow
