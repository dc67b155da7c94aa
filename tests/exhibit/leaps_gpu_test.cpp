// The exposure after every way in which the picture can leap to another state, in a model of the light: it is that of a
// still of this state, from the first picture on.
#include "config/model/exhibit_file.h"
#include "config/model/shipped.h"
#include "runtime/exhibit/open_exhibit.h"
#include "runtime/exhibit/session.h"
#include "runtime/exhibit/session_commands.h"
#include "tests/support/controls.h"
#include "tests/support/files.h"
#include <cmath>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace leaps_gpu_test {

using namespace starbow;
namespace testing = starbow::testing;
using starbow::testing::controls_with;

/// The light of the view, as the exposure that it would be metered with: any function that differs from place to place.
double metered_in(const Session& session)
{
    double sum = double(session.content.scene.string().size() % 7);
    const glm::dvec3 at = session.flight().ship.position.total(), u = session.flight().ship.u.total();
    for (int i = 0; i < 3; ++i)
        sum += 2 * std::sin(at[i] / 3 + i) - std::log1p(std::abs(u[i]));
    return sum - 4;
}

/// An exhibit's session whose frames take a sixtieth of a second, and are metered a frame later, as on a device.
struct Live {
    explicit Live(ExhibitOptions given)
        : options(std::move(given))
        , session(options)
    {
    }

    void frame(Controls controls = {}, double dt_s = 1. / 60)
    {
        RecordEntry entry{.dt_ns = std::int64_t(1e9 * dt_s)};
        entry.controls = std::move(controls);
        step(session, entry, {drawn, {}, {}});
        drawn = metered_in(session);
    }

    /// Somewhere else than at the start, where the eye has adapted to other light, and has changed its brightness.
    void fly_away()
    {
        for (int i = 0; i < 40; ++i)
            frame(controls_with(Steering{.lever = 0.6, .turn = {0.2, 0.3, 0}}), 0.1);
        frame(controls_with(Looking{.exposure = 1}), 0.1);
    }

    ExhibitOptions options;
    Session session;
    std::optional<double> drawn;
};

ExhibitOptions options_of(const SessionContent& content)
{
    ExhibitOptions options;
    options.content = content;
    options.layout = load_layout(shipped_file("layouts", "desk"));
    options.words = words_in("en");
    options.paced = false;
    return options;
}

std::vector<std::string> names_in(const std::string& kind)
{
    std::vector<std::string> names;
    for (const std::filesystem::path& file : testing::shipped("config/" + kind))
        names.push_back(file.stem());
    return names;
}

SessionContent content_of(const std::string& kind, const std::string& name)
{
    return kind == "scenes" ? content_of_scene(name)
        : kind == "shots"   ? content_of_shot(name)
                            : content_of_tour(name, words_in("en"));
}

double number_in(const nlohmann::json& object, const char* name) { return object.value(name, 0.); }

nlohmann::json read(const std::string& kind, const std::string& name)
{
    return nlohmann::json::parse(
        testing::read_text(testing::source_dir() / "config" / kind / (name + ".json")), nullptr, true, true);
}

/// The exposure of the content's first still, from its files' words.
double first_ev(const std::string& kind, const std::string& name)
{
    const nlohmann::json file = read(kind, name);
    if (kind == "scenes")
        return file.contains("start") ? number_in(file["start"], "exposure_ev") : 0;
    if (kind == "shots")
        return number_in(file, "exposure_ev");
    const nlohmann::json& step = file["steps"][0];
    if (step.contains("exposure_ev"))
        return step["exposure_ev"];
    return step["cut"].is_string() ? first_ev("shots", step["cut"]) : number_in(step["cut"], "exposure_ev");
}

/// The exposure of the picture of the leap and of the next ones is that of the still. It may follow the light meanwhile.
void expect_still(Live& live, double still_ev, const std::string& what)
{
    const double at_first = live.session.flight().exposure_ev;
    for (int i = 0; i < 4; ++i) {
        EXPECT_NEAR(live.session.light.ev(), still_ev + live.session.flight().exposure_ev - at_first, 0.05)
            << what << ", picture " << i << " after the leap";
        live.frame({}, 1e-3);
    }
}

TEST(Leaps, EveryProgrammeBeginsWithTheExposureOfItsStill)
{
    std::vector<std::pair<std::string, std::string>> all;
    for (const char* kind : {"scenes", "shots", "tours"})
        for (const std::string& name : names_in(kind))
            all.emplace_back(kind, name);
    ASSERT_GT(all.size(), 50u);
    Live live(options_of(content_of_shot("avenue-gamma4")));
    // From each content to the next one in three orders; with STARBOW_ALL_CASES from each to each.
    const std::vector<std::size_t> strides{1, 7, 19};
    const std::size_t every = testing::all_cases() ? all.size() : strides.size();
    for (std::size_t order = 0; order < every; ++order)
        for (std::size_t i = 0; i < all.size(); ++i) {
            const std::size_t stride = every == all.size() ? order + 1 : strides[order];
            const auto& [kind, name] = all[i * stride % all.size()];
            begin_content(live.session, content_of(kind, name));
            live.frame({}, 1e-3);
            expect_still(live, first_ev(kind, name), kind + " " + name);
            live.fly_away();
            live.frame(controls_with(i % 2 == 0 ? Switches{Switch::lock_exposure} : Switches{}));
        }
}

TEST(Leaps, ATouchOutOfAnAttractionIsABeginning)
{
    for (const std::string& name : names_in("exhibits")) {
        Exhibit exhibit = load_exhibit(testing::source_dir() / "config/exhibits" / (name + ".json"));
        exhibit.remote = {}; // its PINs are the operator's
        ExhibitOptions options = open_exhibit(exhibit);
        if (!options.visiting)
            options.visiting.emplace();
        std::vector<std::string> attractions = options.visiting->attract;
        if (attractions.empty())
            attractions = names_in("tours");
        options.visiting->attract = attractions;
        options.paced = false;
        Live live(options);
        const double start_ev = options.content.start.exposure_ev;
        for (std::size_t i = 0; i < attractions.size(); ++i)
            for (const int seconds : {0, 1, 20, 90}) {
                begin_content(live.session, attraction_of(live.options, live.session.words, i), false);
                for (int s = 0; s < seconds; ++s)
                    live.frame({}, 1);
                begin_content(live.session, live.options.content);
                live.frame({}, 1e-3);
                expect_still(live, start_ev, name + " after " + std::to_string(seconds) + " s of " + attractions[i]);
            }
    }
}

TEST(Leaps, AResetLeadsToTheStartsExposure)
{
    for (const std::string& name : names_in("shots")) {
        Live live(options_of(content_of_shot(name)));
        live.frame();
        live.fly_away();
        live.frame(controls_with(Switches{Switch::reset}), 1e-3);
        expect_still(live, first_ev("shots", name), name);
        live.fly_away();
        forget_directions(live.session); // as the command reset does
        begin_content(live.session, live.options.content);
        live.frame(controls_with(Switches{Switch::reset}), 1e-3);
        expect_still(live, first_ev("shots", name), name + ", by the docent");
    }
}

TEST(Leaps, ToursHandOverWithTheirOwnExposure)
{
    int hand_overs = 0, cuts = 0;
    for (const std::string& name : names_in("tours")) {
        const nlohmann::json file = read("tours", name);
        for (const double rest_s : {0.3, 4.}) { // how long the visitor stays in each step
            Live live(options_of(content_of_tour(name, words_in("en"))));
            live.frame();
            std::size_t step = 0;
            bool flew = false;
            for (int presses = 0; presses < 60 && !live.session.tour()->over(); ++presses) {
                for (double t = 0; t < rest_s; t += 0.1)
                    live.frame(controls_with(Steering{.lever = flew ? 0.7 : 0.}), 0.1);
                live.frame(controls_with(Switches{Switch::home}), 1e-3);
                const bool flies = live.session.source->by_hand(),
                           cut = file["steps"][live.session.tour()->step()].contains("cut");
                const std::string what = name + ", step " + std::to_string(live.session.tour()->step());
                if (live.session.tour()->step() != step && cut)
                    ++cuts, expect_still(live, live.session.flight().exposure_ev, what + ", a cut");
                else if (flies && !flew)
                    ++hand_overs, expect_still(live, live.session.flight().exposure_ev, what + ", handed over");
                step = live.session.tour()->step(), flew = flies;
            }
            live.fly_away();
            live.frame(controls_with(Switches{Switch::reset}), 1e-3);
        }
    }
    EXPECT_GT(hand_overs, 10);
    EXPECT_GT(cuts, 20);
}

TEST(Leaps, TenSecondsBackAndAStopAreAdaptedToAtOnce)
{
    for (const bool stops : {false, true}) {
        Live live(options_of(content_of_shot("avenue-rest")));
        live.frame();
        const double offset = first_ev("shots", "avenue-rest") - metered_in(live.session);
        live.frame();
        for (int i = 0; i < 80; ++i)
            live.frame(controls_with(Steering{.lever = 0.9}), 0.1);
        live.frame(controls_with(Switches{stops ? Switch::stop : Switch::undo}), 1e-3);
        live.frame({}, 1e-3);
        EXPECT_NEAR(live.session.light.ev(), metered_in(live.session) + offset, 0.05) << stops;
    }
}

/// A record that is played again leaps as the flight did, and shows the same exposures.
TEST(Leaps, AReplayHasTheFlightsExposures)
{
    ExhibitOptions options = options_of(content_of_shot("avenue-gamma4"));
    options.record = testing::scratch("leaps.jsonl");
    std::vector<double> shown;
    {
        Live live(options);
        for (int i = 0; i < 200; ++i) {
            Controls hands = controls_with(Steering{.lever = 0.5 + 0.4 * std::sin(i)});
            hands.set(Switch::stop, i % 60 == 59), hands.set(Switch::undo, i % 50 == 49);
            hands.set(Switch::reset, i % 77 == 76);
            live.frame(hands);
            shown.push_back(live.session.light.ev());
        }
        live.session.record_replay.end(live.session.flight(), [](const std::string&) {});
        live.session.record_replay.close();
    }
    options.replay = std::exchange(options.record, {});
    Live again(options);
    RecordEntry entry;
    for (std::size_t i = 0; i < shown.size(); ++i) {
        ASSERT_TRUE(again.session.record_replay.play(entry));
        step(again.session, entry, {});
        EXPECT_NEAR(again.session.light.ev(), shown[i], 1e-9) << i;
    }
}

} // namespace leaps_gpu_test
