// The guide's window as data: its keys, its lists, and whether its texts fit their places.
#include "config/model/programme_file.h"
#include "config/model/shipped.h"
#include "config/model/tour_file.h"
#include "runtime/hud/hud.h"
#include "runtime/hud/presenter_picture.h"
#include "tests/support/files.h"
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <set>

namespace presenter_test {

using namespace starbow;

namespace {

PresenterState some_state(const Words& words = words_in("en"))
{
    PresenterState state;
    state.information = Information::visitor;
    state.doing = Doing::flies;
    state.scene = "avenue", state.language = words.language;
    state.speed = 0.96825, state.gamma = 4, state.max_gamma = 7.0888;
    for (const std::string& name : shipped_names("scenes"))
        state.scenes.emplace_back(name, words.title("scene", name));
    for (const std::string& name : shipped_names("tours"))
        state.tours.emplace_back(name, words.title("tour", name));
    for (const std::string& name : shipped_names("shots"))
        state.shots.emplace_back(name, words.title("shot", name));
    for (const std::string& name : shipped_names("words"))
        state.languages.emplace_back(name, words_in(name)("remote.this_language"));
    return state;
}

/// The same while a shipped tour shows a step.
PresenterState toured(const Words& words, const std::string& name, std::size_t step)
{
    PresenterState state = some_state(words);
    state.doing = Doing::tour, state.tour = name, state.step = int(step) + 1, state.left_s = 7.2;
    for (const Step& one : tour_in(name, words).steps)
        state.cues.push_back({one.caption.empty() ? "–" : one.caption, one.seconds});
    state.steps = int(state.cues.size());
    return state;
}

/// The same in the shipped programme's item, counted from 1.
PresenterState with_programme(PresenterState state, const Words& words, int item)
{
    for (const ProgrammeItem& one : load_programme(shipped_file("programmes", "evening")).items) {
        const auto& [kind, name] = shown_by(one);
        state.programme.push_back({words.title(kind, name), said(one.notes, words), one.minutes});
    }
    state.item = item, state.items = int(state.programme.size()), state.item_s = 83.9;
    return state;
}

std::set<CommandKind> given_by(const PresenterState& state)
{
    std::set<CommandKind> kinds;
    const Words words = words_in("en");
    for (const PresenterList list : {PresenterList::worlds, PresenterList::tours, PresenterList::views,
             PresenterList::limits, PresenterList::languages}) {
        PresenterHands hands{.list = list};
        const PresenterSheet sheet = sheet_of(state, hands, words);
        for (const auto* keys : {&sheet.choices, &sheet.keys})
            for (const PresenterKey& key : *keys)
                if (const auto* command = std::get_if<Command>(&key.deed))
                    kinds.insert(command->kind);
                else if (std::holds_alternative<TypeCaption>(key.deed))
                    kinds.insert(CommandKind::caption);
    }
    kinds.insert({CommandKind::pointer, CommandKind::touch}); // the mouse's, on the visitors' picture
    return kinds;
}

/// Presses keys one after the other, each on the sheet as it then is. Returns the last one's command.
std::optional<Command> after(const PresenterState& state, PresenterHands& hands, std::initializer_list<int> keys)
{
    std::optional<Command> command;
    for (const int key : keys)
        command = press(sheet_of(state, hands, words_in("en")), hands, key);
    return command;
}

Command on(CommandKind kind, bool is = true) { return {.kind = kind, .on = is}; }
Command shows(Effect which, bool is = true) { return {.kind = CommandKind::effect, .on = is, .effect = which}; }

} // namespace

TEST(Presenter, EveryCommandOfADocentHasAKeyAndNoneOfAnEngineer)
{
    const std::set<CommandKind> given = given_by(some_state());
    for (const CommandRule& rule : command_rules())
        EXPECT_EQ(given.contains(rule.kind), rule.role == Role::docent) << rule.name;
}

TEST(Presenter, NoKeyMeansTwoThings)
{
    for (const PresenterList list : {PresenterList::worlds, PresenterList::views}) {
        const PresenterSheet sheet = sheet_of(some_state(), {.list = list}, words_in("en"));
        std::set<int> keys{keys::escape, keys::enter, keys::backspace};
        for (const auto* all : {&sheet.choices, &sheet.keys})
            for (const PresenterKey& key : *all) {
                EXPECT_TRUE(keys.insert(key.key).second) << key.label;
                EXPECT_TRUE(key.also == 0 || keys.insert(key.also).second) << key.label;
                EXPECT_TRUE(key.key > 255 || key.key == ' ' || key.name == std::string(1, char(key.key))) << key.label;
            }
        EXPECT_GE(sheet.keys.size(), 26u);
    }
}

TEST(Presenter, AListShowsEveryShippedFileAndNothingElse)
{
    const PresenterState state = some_state();
    for (const auto& [key, names] :
        {std::pair{'W', state.scenes}, {'T', state.tours}, {'V', state.shots}, {'L', state.languages}}) {
        PresenterHands hands;
        after(state, hands, {key});
        std::vector<std::string> offered;
        for (std::size_t page = 0; page < (names.size() + 9) / 10; ++page) {
            const PresenterSheet sheet = sheet_of(state, hands, words_in("en"));
            for (const PresenterKey& choice : sheet.choices)
                if (const auto* command = std::get_if<Command>(&choice.deed))
                    offered.push_back(command->text);
            press(sheet, hands, 'M');
        }
        std::vector<std::string> shipped;
        for (const auto& [name, text] : names)
            shipped.push_back(name);
        EXPECT_EQ(offered, shipped) << char(key);
    }
}

TEST(Presenter, KeysGiveTheCommandsThatTheyName)
{
    PresenterState state = some_state();
    PresenterHands hands;
    using enum CommandKind;
    EXPECT_EQ(after(state, hands, {'H'}), on(hold));
    EXPECT_EQ(after(state, hands, {'B'}), on(fade));
    EXPECT_EQ(after(state, hands, {'D'}), shows(Effect::doppler, false)); // it is on
    EXPECT_EQ(after(state, hands, {'S'}), on(slow_motion));
    EXPECT_EQ(after(state, hands, {keys::page_down}), Command{.kind = next}); // a clicker's key
    EXPECT_EQ(after(state, hands, {keys::left}), Command{.kind = back});
    EXPECT_EQ(after(state, hands, {'C'}), (Command{.kind = comparison, .text = "galilean"}));
    EXPECT_EQ(after(with_programme(state, words_in("en"), 2), hands, {'.'}), (Command{.kind = item, .number = 3}));
    EXPECT_EQ(after(with_programme(state, words_in("en"), 2), hands, {','}), (Command{.kind = item, .number = 1}));
    EXPECT_EQ(after(state, hands, {'G', '2'}), (Command{.kind = speed_limit, .number = 2.2942}));
    EXPECT_EQ(after(state, hands, {'L', '1'}), (Command{.kind = language, .text = "de"}));
    EXPECT_EQ(after(state, hands, {keys::up}), (Command{.kind = exposure, .number = 0.5}));
    state.exposure_ev = -10, state.hold = true;
    EXPECT_EQ(after(state, hands, {keys::down}), (Command{.kind = exposure, .number = -10})); // the least
    EXPECT_EQ(after(state, hands, {'H'}), on(hold, false));
    // A list stays until another one is opened, or Escape leads back to the worlds.
    EXPECT_EQ(after(state, hands, {'T', '1'}), (Command{.kind = tour, .text = state.tours[0].first}));
    EXPECT_EQ(after(state, hands, {'0'}), std::nullopt); // there are no ten tours
    EXPECT_EQ(after(state, hands, {keys::escape, '0'}), (Command{.kind = scene, .text = state.scenes[9].first}));
    EXPECT_EQ(after(state, hands, {'V', 'M', '1'}), (Command{.kind = shot, .text = state.shots[10].first}));
    constexpr int f25 = 314; // no letter: a later effect may have any
    EXPECT_EQ(after(state, hands, {f25}), std::nullopt);
}

TEST(Presenter, ASecondPressWithinAFrameGoesOnFromTheFirst)
{
    PresenterState state = some_state();
    state.effects.on.set(Effect::headlight, false);
    PresenterHands hands;
    const auto twice = [&](int key) {
        const std::optional<Command> first = after(state, hands, {key});
        PresenterState then = state;
        static_cast<ExhibitState&>(then) = starbow::after(state, first.value());
        return after(then, hands, {key}).value();
    };
    using enum CommandKind;
    for (const auto& [key, kind] : {std::pair{'H', hold}, {'B', fade}, {'P', pause}, {'S', slow_motion}, {'U', range}})
        EXPECT_EQ(twice(key), on(kind, false));
    EXPECT_EQ(twice('A'), shows(Effect::aberration)); // it is on
    EXPECT_EQ(twice('D'), shows(Effect::doppler));
    EXPECT_EQ(twice('E'), shows(Effect::headlight, false));
    EXPECT_EQ(twice('F'), shows(Effect::false_colours, false));
    EXPECT_EQ(twice('C'), (Command{.kind = comparison, .text = "no-light-delay"}));
    EXPECT_EQ(twice('X'), (Command{.kind = inset, .text = "aberration"}));
    EXPECT_EQ(twice('I'), (Command{.kind = information, .text = "laboratory"}));
    EXPECT_EQ(twice('O'), on(one_button, false));
    EXPECT_EQ(twice('N'), on(left_handed, false));
    EXPECT_EQ(twice(keys::up), (Command{.kind = exposure, .number = 1}));
    EXPECT_EQ(twice(keys::right), Command{.kind = next});
}

TEST(Presenter, EveryGivenCommandIsOneThatARecordReadsBack)
{
    const PresenterState state = some_state();
    for (const PresenterList list : {PresenterList::worlds, PresenterList::tours, PresenterList::views,
             PresenterList::limits, PresenterList::languages}) {
        const PresenterSheet sheet = sheet_of(state, {.list = list}, words_in("en"));
        for (const auto* keys : {&sheet.choices, &sheet.keys})
            for (const PresenterKey& key : *keys)
                if (const auto* command = std::get_if<Command>(&key.deed)) {
                    EXPECT_EQ(command_of(words_of(*command)), *command) << key.label;
                }
    }
}

TEST(Presenter, ACaptionIsTypedAndNoKeyIsACommandMeanwhile)
{
    const PresenterState state = some_state();
    PresenterHands hands;
    EXPECT_EQ(after(state, hands, {'K'}), std::nullopt);
    type(hands, 'B');
    type(hands, U'ü');
    type(hands, U'γ');
    EXPECT_EQ(after(state, hands, {'B', keys::page_down}), std::nullopt);
    EXPECT_EQ(hands.typed, "Büγ");
    after(state, hands, {keys::backspace, keys::backspace});
    EXPECT_EQ(hands.typed, "B");
    EXPECT_EQ(after(state, hands, {keys::enter}), (Command{.kind = CommandKind::caption, .text = "B"}));
    EXPECT_FALSE(hands.typed);
    // An empty one takes the shown one away; Escape leaves everything as it is.
    EXPECT_EQ(after(state, hands, {'K', keys::enter}), Command{.kind = CommandKind::caption});
    EXPECT_EQ(after(state, hands, {'K', keys::escape}), std::nullopt);
    EXPECT_FALSE(hands.typed);
    after(state, hands, {'K'});
    for (int i = 0; i < 300; ++i)
        type(hands, U'γ');
    EXPECT_EQ(hands.typed->size(), most_command_text);
    type(hands, 7); // no character
    EXPECT_EQ(hands.typed->size(), most_command_text);
}

TEST(Presenter, TheCueSheetSaysWhereTheTourIs)
{
    const Words words = words_in("en");
    const PresenterSheet sheet = sheet_of(toured(words, "rainbow", 2), {}, words);
    EXPECT_EQ(sheet.cue_title, "The rainbow · step 3 of " + std::to_string(sheet.cues.size()) + " · 0:08 left");
    EXPECT_EQ(sheet.step, 2u);
    EXPECT_TRUE(sheet.cues[3].text.starts_with("A rainbow!")) << sheet.cues[3].text;
    const auto usable
        = [](const PresenterSheet& of, int key) { return std::ranges::find(of.keys, key, &PresenterKey::key)->usable; };
    EXPECT_TRUE(usable(sheet, keys::right));
    EXPECT_FALSE(usable(sheet_of(some_state(), {}, words), keys::right));
    EXPECT_EQ(sheet_of(some_state(), {}, words).cue_title, "No tour is shown");
}

TEST(Presenter, ItSaysWhatTheVisitDoesAndWhatElseIsSo)
{
    const Words words = words_in("en");
    PresenterState state = some_state(words);
    EXPECT_EQ(sheet_of(state, {}, words).facts[0].second, "A visitor is flying");
    state.doing = Doing::attract_tour, state.calm = true, state.hold = true;
    const PresenterSheet sheet = sheet_of(state, {}, words);
    EXPECT_EQ(sheet.facts[0].second, "An attract tour is running");
    EXPECT_EQ(sheet.facts[1].second, "the stick is locked, calm");
    state.coming = "twins";
    EXPECT_EQ(sheet_of(state, {}, words).facts[2].second, "on the way: The twins");
}

/// gamma^2 (1 - beta^2) = 1 with the read number, to its last digit.
TEST(Presenter, SpeedLimitsAreReadAsPartsOfLightsSpeed)
{
    for (const std::string language : {"en", "de"}) {
        const Words words = words_in(language);
        const PresenterSheet sheet = sheet_of(some_state(words), {.list = PresenterList::limits}, words);
        ASSERT_EQ(sheet.choices.size(), offered_limits.size());
        for (std::size_t i = 0; i + 1 < offered_limits.size(); ++i) {
            std::string text = sheet.choices[i].label;
            ASSERT_TRUE(text.ends_with(" c")) << text;
            std::ranges::replace(text, ',', '.');
            const double beta = std::stod(text), gamma = 1 / std::sqrt(1 - beta * beta);
            EXPECT_NEAR(gamma / offered_limits[i], 1, 1e-3) << text;
            EXPECT_LT(beta, 1);
        }
    }
}

TEST(Presenter, TheProgrammeShowsItsItemNotesTimeAndTheNext)
{
    const Words words = words_in("en");
    const PresenterSheet sheet = sheet_of(with_programme(some_state(words), words, 2), {}, words);
    EXPECT_EQ(sheet.item_title, "item 2 of 6 · The first minute · 1:23 of 3 min");
    EXPECT_EQ(sheet.item_notes, "The tour asks a question. Let the audience vote before you press next.");
    EXPECT_EQ(sheet.item_then, "Then: A ride through the street");
    EXPECT_EQ(sheet_of(with_programme(some_state(words), words, 6), {}, words).item_then, "");
    const PresenterSheet before = sheet_of(with_programme(some_state(words), words, 0), {}, words);
    EXPECT_EQ(before.item_title, "The programme has not begun.");
    EXPECT_EQ(before.item_then, "Then: The avenue, as visits begin");
    EXPECT_EQ(sheet_of(some_state(words), {}, words).item_title, "");
    EXPECT_EQ(places_of(sheet_of(some_state(words), {}, words), {1280, 800}).programme.size.x, 0);
}

TEST(Presenter, PlacesLieInTheWindowAndDoNotOverlap)
{
    for (const glm::ivec2 size : {glm::ivec2(1280, 800), {800, 600}, {1920, 1080}, {3840, 2160}, {640, 480}}) {
        const Words words = words_in("de");
        const PresenterSheet sheet
            = sheet_of(with_programme(some_state(words), words, 1), {.list = PresenterList::views}, words);
        const PresenterPlaces places = places_of(sheet, size);
        std::vector<PresenterBox> all{places.picture, places.facts, places.programme, places.cues, places.said};
        all.insert(all.end(), places.keys.begin(), places.keys.end());
        all.insert(all.end(), places.choices.begin(), places.choices.end());
        ASSERT_EQ(places.choices.size(), 11u);
        for (std::size_t i = 0; i < all.size(); ++i) {
            const auto& [corner, extent] = all[i];
            EXPECT_TRUE(corner.x >= 0 && corner.y >= 0 && corner.x + extent.x <= size.x && corner.y + extent.y <= size.y)
                << i;
            EXPECT_GT(std::min(extent.x, extent.y), size.y / 40) << i;
            for (std::size_t j = 0; j < i; ++j) {
                const glm::ivec2 low = glm::max(corner, all[j].corner),
                                 high = glm::min(corner + extent, all[j].corner + all[j].size);
                EXPECT_FALSE(low.x < high.x && low.y < high.y) << i << " and " << j << " at " << size.x << "x" << size.y;
            }
        }
        for (std::size_t i = 0; i < sheet.keys.size(); ++i)
            EXPECT_EQ(key_at(sheet, size, places.keys[i].corner + places.keys[i].size / 2), sheet.keys[i].key);
        for (std::size_t i = 0; i < sheet.choices.size(); ++i)
            EXPECT_EQ(key_at(sheet, size, places.choices[i].corner), sheet.choices[i].key);
        EXPECT_EQ(key_at(sheet, size, places.picture.corner + 1), 0);
    }
}

TEST(Presenter, BothLanguagesFitTheirPlaces)
{
    const Typesetter typesetter;
    PresenterPicture picture;
    for (const std::string& language : shipped_names("words"))
        for (const glm::ivec2 size : {glm::ivec2(1280, 800), {1920, 1080}, {1024, 768}})
            for (const PresenterList list : {PresenterList::worlds, PresenterList::tours, PresenterList::views,
                     PresenterList::limits, PresenterList::languages}) {
                const Words words = words_in(language);
                PresenterState state = with_programme(toured(words, "simultaneity", 4), words, 5);
                state.paused = state.hold = true, state.exposure_ev = -9.5, state.effects.comparison = Comparison::galilean;
                const PresenterSheet sheet = sheet_of(state, {.list = list}, words);
                Thumbnails thumbnails; // of the size that the program draws
                for (const PresenterKey& choice : sheet.choices)
                    if (const std::string name = thumbnail_of(choice); !name.empty())
                        thumbnails[name] = {{192, 108}, std::vector<std::uint8_t>(3 * 192 * 108)};
                paint(sheet, {}, thumbnails, typesetter, size, false, picture);
                EXPECT_GE(picture.tightest, 0.75) << language << " " << size.x << "x" << size.y << " list " << int(list);
            }
}

TEST(Presenter, NoButtonsLettersLeaveIt)
{
    const Typesetter typesetter;
    PresenterPicture picture;
    for (const std::string& language : shipped_names("words"))
        for (const glm::ivec2 size : {glm::ivec2(1280, 800), {1920, 1080}, {1024, 768}, {800, 600}}) {
            const Words words = words_in(language);
            PresenterState state = with_programme(toured(words, "simultaneity", 4), words, 5);
            state.exposure_ev = -9.5, state.effects.comparison = Comparison::galilean;
            const PresenterSheet sheet = sheet_of(state, {}, words);
            paint(sheet, {}, {}, typesetter, size, false, picture);
            const PresenterPlaces places = places_of(sheet, size);
            const auto brightest = [&](const PresenterBox& box) {
                int most = 0;
                for (int y = box.corner.y; y < std::min(size.y, box.corner.y + box.size.y); ++y)
                    for (int x = box.corner.x; x < box.corner.x + box.size.x; ++x)
                        most = std::max(most, int(picture.texels[4 * std::size_t(y * size.x + x) + 1]));
                return most;
            };
            for (std::size_t i = 0; i < places.keys.size(); ++i) {
                const auto& [corner, extent] = places.keys[i];
                const int gap = std::max(2, extent.y / 10);
                EXPECT_LE(corner.y + extent.y, size.y);
                // The button's lowest rows are its ground, and below it is the window's.
                EXPECT_LT(brightest({{corner.x + 60, corner.y + extent.y - 1}, {extent.x - 60, 1}}), 90)
                    << language << " " << size.x << " " << sheet.keys[i].label;
                EXPECT_LT(brightest({{corner.x, corner.y + extent.y}, {extent.x, gap}}), 40)
                    << language << " " << size.x << " " << sheet.keys[i].label;
            }
        }
}

TEST(Presenter, ItsPictureHasLettersTheVisitorsViewAndTheMarkedStep)
{
    const Typesetter typesetter;
    const Words words = words_in("en");
    const PresenterSheet sheet = sheet_of(with_programme(toured(words, "rainbow", 2), words, 2), {}, words);
    SmallPicture view{.size = {4, 2}, .rgb = std::vector<std::uint8_t>(24, 0)};
    for (std::size_t i = 0; i < view.rgb.size(); i += 3)
        view.rgb[i] = 200, view.rgb[i + 1] = 10, view.rgb[i + 2] = 20;
    PresenterPicture red_first, blue_first;
    const glm::ivec2 size(1280, 800);
    paint(sheet, view, {}, typesetter, size, false, red_first);
    paint(sheet, view, {}, typesetter, size, true, blue_first);
    const auto texel = [&](const PresenterPicture& of, glm::ivec2 at) {
        const std::uint8_t* p = &of.texels[4 * std::size_t(at.y * size.x + at.x)];
        return std::array<int, 4>{p[0], p[1], p[2], p[3]};
    };
    const PresenterPlaces places = places_of(sheet, size);
    const glm::ivec2 middle = places.picture.corner + places.picture.size / 2;
    EXPECT_EQ(texel(red_first, middle), (std::array{200, 10, 20, 255}));
    EXPECT_EQ(texel(blue_first, middle), (std::array{20, 10, 200, 255}));
    const auto letters = [&](const PresenterBox& box) {
        int bright = 0;
        for (int y = box.corner.y; y < box.corner.y + box.size.y; ++y)
            for (int x = box.corner.x; x < box.corner.x + box.size.x; ++x)
                bright += texel(red_first, {x, y})[1] > 150;
        return bright;
    };
    for (const PresenterBox& box : places.keys)
        EXPECT_GT(letters(box), 60);
    EXPECT_GT(letters(places.cues), 2000);
    // The marked step has a ground of its own, so that a glance finds it.
    int marked = 0;
    for (int y = places.cues.corner.y; y < places.cues.corner.y + places.cues.size.y; ++y)
        marked += texel(red_first, {places.cues.corner.x + 3, y})[2] > 90;
    EXPECT_GT(marked, 25);
    EXPECT_LT(marked, 160);
}

TEST(Presenter, EachChoiceHasItsSmallPictureAtItsRight)
{
    const Typesetter typesetter;
    const Words words = words_in("en");
    const glm::ivec2 size(1280, 800);
    for (const auto& [list, first] : {std::pair{PresenterList::worlds, "scene/"}, {PresenterList::tours, "tour/"},
             {PresenterList::views, "shot/"}, {PresenterList::limits, ""}, {PresenterList::languages, ""}}) {
        const PresenterSheet sheet = sheet_of(toured(words, "rainbow", 2), {.list = list}, words);
        ASSERT_GE(sheet.choices.size(), 2u);
        for (const PresenterKey& choice : sheet.choices) {
            const Command* command = std::get_if<Command>(&choice.deed);
            EXPECT_EQ(thumbnail_of(choice), command && *first != '\0' ? first + command->text : "");
        }
        if (*first == '\0')
            continue;
        // Two columns, blue at the left and red at the right, shrunk to the row's height.
        SmallPicture two{{192, 108}, {}};
        for (int i = 0; i < 192 * 108; ++i)
            two.rgb.insert(two.rgb.end(), {std::uint8_t(i % 192 < 96 ? 0 : 250), 0, std::uint8_t(i % 192 < 96 ? 250 : 0)});
        PresenterPicture without, with;
        paint(sheet, {}, {}, typesetter, size, false, without);
        paint(sheet, {}, {{thumbnail_of(sheet.choices[1]), two}}, typesetter, size, false, with);
        const PresenterBox box = places_of(sheet, size).choices[1];
        int reds = 0, blues = 0, others = 0;
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x) {
                const std::size_t at = 4 * std::size_t(y * size.x + x);
                const std::array<int, 3> texel{with.texels[at], with.texels[at + 1], with.texels[at + 2]};
                const bool red = texel == std::array{250, 0, 0}, blue = texel == std::array{0, 0, 250},
                           inside = box.holds({x, y});
                reds += red && inside, blues += blue && inside;
                others += !inside && !std::equal(&with.texels[at], &with.texels[at + 4], &without.texels[at]);
                if (red) {
                    EXPECT_GE(x, box.corner.x + box.size.x - box.size.y);
                }
            }
        const int half = box.size.y * box.size.y * 8 / 9;
        EXPECT_NEAR(reds, half, 2 * box.size.y);
        EXPECT_NEAR(blues, half, 2 * box.size.y);
        EXPECT_EQ(others, 0);
    }
}

TEST(Presenter, ItIsPaintedAtAnySize)
{
    const Typesetter typesetter;
    const Words words = words_in("de");
    PresenterPicture picture;
    const PresenterSheet sheet = sheet_of(toured(words, "twins", 0), {.typed = "Grüße"}, words);
    for (const glm::ivec2 size : {glm::ivec2(64, 64), {64, 2000}, {3000, 64}, {301, 703}}) {
        paint(sheet, {.size = {3, 3}, .rgb = std::vector<std::uint8_t>(27, 9)}, {}, typesetter, size, true, picture);
        EXPECT_EQ(picture.texels.size(), 4 * std::size_t(size.x) * std::size_t(size.y));
    }
}

} // namespace presenter_test
