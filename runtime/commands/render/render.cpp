#include "config/json/error.h"
#include "config/json/reader.h"
#include "config/model/shipped.h"
#include "replay.h"
#include "runtime/commands/commands.h"
#include "runtime/commands/options/command_line.h"
#include "runtime/commands/options/language.h"
#include "runtime/commands/options/pattern.h"
#include "runtime/commands/options/quality.h"
#include "runtime/commands/options/size.h"
#include "runtime/commands/options/spectra.h"
#include "runtime/commands/options/still_shot.h"
#include "runtime/commands/tools.h"
#include "runtime/exhibit/callouts.h"
#include "runtime/exhibit/picture_setup.h"
#include "runtime/exhibit/still_measurement.h"
#include "runtime/render/offscreen.h"
#include "runtime/render/render_context.h"
#include "thumbnails.h"
#include "tour.h"
#include <algorithm>
#include <cstdio>
#include <optional>

namespace starbow {
namespace {

struct RenderOptions {
    std::string layout, shot, out, size, pattern = "none", exposure = "shot", mode = "eye", spectra = "needed", replay,
                                         frames, language = "en", information = "laboratory", tour, movie, points,
                                         overlay = "off", why = "none", quality, part, scene, effects;
    std::vector<std::string> others;
    long frames_per_s = 30;
    long every = 1, samples = 16;
    double bloom = 0;
    bool exr = false, hud = false, sky_names = false, reference = false, join = false, by_eye = false, thumbnails = false;
};

std::vector<std::string> reference_arguments(const RenderOptions& options)
{
    std::vector<std::string> arguments{
        reference_tool.name, "--samples=" + std::to_string(options.samples), "--out=" + options.out};
    // An option without a value would take the next one for it.
    for (const auto& [name, value] : {std::pair("--shot=", &options.shot), {"--scene=", &options.scene},
             {"--layout=", &options.layout}, {"--size=", &options.size}})
        if (!value->empty())
            arguments.push_back(name + *value);
    if (options.exr)
        arguments.push_back("--exr");
    return arguments;
}

int render(const RenderOptions& options)
{
    if (options.thumbnails)
        return render_thumbnails();
    if (!options.movie.empty() && options.tour.empty() && options.replay.empty())
        throw InputError("--movie is given without --tour and --replay; one of them is right");
    if (options.tour.empty() && options.movie.empty() && options.out.empty())
        throw InputError("--out is required here; the folder for the pictures, such as out/shot, is right");
    const FilmOptions film{options.movie, options.frames_per_s, options.part.empty() ? FilmPart{} : film_part(options.part),
        options.join, options.others};
    if (!options.replay.empty())
        return render_replay({options.replay, options.layout, options.out, options.size, options.frames, options.language,
            film, options.every, options.hud, information_named(options.information)});
    if (!options.tour.empty())
        return render_tour({options.tour, options.layout, options.size, options.language, film, options.bloom});
    const StillShot still = still_shot(options.shot, options.scene);
    if (options.reference && options.exposure != "shot")
        throw InputError("--exposure " + options.exposure + " is not known to --reference; shot is right there");
    if (options.reference)
        become_tools(reference_arguments(options));
    const Words words = words_in(options.language);
    Shot shot = still.shot;
    if (!options.effects.empty())
        shot.effects.on = effects_named(options.effects);
    const Layout layout = layout_in_size(options.layout, options.size);
    const Pattern pattern = pattern_named(options.pattern);
    std::vector<std::filesystem::path> pictures;
    for (const Output& output : layout.outputs)
        for (const Viewport& viewport : output.viewports)
            pictures.insert(pictures.end(), {viewport.alpha_mask, viewport.black_level});
    for (const Output& output : layout.outputs)
        for (const char* kind : {".png", ".exr"})
            if (options.exr || kind == std::string(".png")) {
                const std::filesystem::path picture = std::filesystem::path(options.out) / (output.name + kind);
                check_not_read(picture, pictures);
                check_writable(picture);
            }
    parse_points(options.points, layout);
    // Errors in the files are reported before the device is opened.
    const std::optional<Quality> quality = chosen_quality(options.quality);
    const auto level = options.spectra == "needed" && quality ? quality->spectra : level_of(options.spectra);
    RenderContext context(still.scene, device_options(false), level);
    for (const std::string& note : context.world.world.notes)
        std::fprintf(
            stderr, "starbow: %s: %s\n", one_line(context.world.scene.gltf.string()).c_str(), one_line(note).c_str());
    OffscreenRenderer renderer(context.device, context.pipelines, context.world, layout,
        quality ? within(context.device, *quality) : default_quality(context.device, true), options.exr);
    renderer.frame().show(pattern);
    renderer.frame().bloom(options.bloom);
    if (options.exposure == "auto") {
        const Exposing rules;
        shot.exposure_ev = std::clamp(renderer.metered(shot).value_or(shot.exposure_ev), rules.min_ev, rules.max_ev);
    }
    const double eyes_ev = shot.exposure_ev;
    std::optional<RangeCurve> curve;
    if (options.mode == "range") {
        curve = renderer.ranged(shot);
        renderer.frame().range(curve);
        shot.exposure_ev = 0; // of an eye's exposure, the curve has what it needs
    }
    std::optional<Panel> panel;
    const StillMeasurement measurement = measure_still(renderer, context.world, shot, parse_points(options.points, layout),
        options.overlay, options.why, words, options.by_eye);
    if (options.hud) {
        Readings shown = readings(ship_at(shot), context.world.scene, shot.effects);
        shown.exposure_ev = shot.exposure_ev;
        if (curve)
            shown.range = Readings::Range{curve->stops(), curve->shown_stops()};
        show_on(information_named(options.information), shown.world_s, shown); // the shot is the start
        panel = Typesetter().draw(shown, words, renderer.frame().views().hud_width());
    }
    PictureSetup names;
    if (options.sky_names) {
        PictureState now{.shot = shot, .range = curve, .bloom = options.bloom};
        name_sky(context.world, options.language, now);
        names.set_up(now, words, renderer.frame());
    }
    render_still(options.out, renderer, shot, options.exr, panel ? &*panel : nullptr);
    std::printf("%s\n", describe_light(context).c_str());
    for (const std::string& line : measurement.lines)
        std::printf("%s\n", line.c_str());
    if (options.exposure == "auto")
        std::printf("exposure %.2f EV\n", eyes_ev);
    if (curve)
        std::printf("brightness compressed: %.1f stops shown in %.1f\n", curve->stops(), curve->shown_stops());
    for (const Output& output : layout.outputs)
        std::printf("%s/%s.png%s\n", options.out.c_str(), output.name.c_str(), options.exr ? " and .exr" : "");
    return context.device.complaints.empty() ? 0 : 1;
}

} // namespace

static void add_render(Subcommand& app, std::function<int()>& chosen)
{
    auto options = std::make_shared<RenderOptions>();
    Subcommand* command = app.add_subcommand(
        "render", "Draw one shot off-screen, the same bytes every time; or a flight's record, or a tour's movie.");
    command->add_option("--layout", options->layout,
        "A layout file, or the name of one in config/layouts [desk; for a replay the record's]");
    Option* shot = command->add_option("--shot", options->shot, "A shot file, or the name of one in config/shots");
    Option* scene = command->add_option("--scene", options->scene,
        "A scene or glTF file, or the name of a scene in config/scenes: its start; with --shot: the shot in this scene");
    Option* out = command->add_option("--out", options->out,
        "The folder for OUTPUT.png (and OUTPUT.exr), or with --replay OUTPUT-FRAME.png; made if it is not there");
    command->add_option("--size", options->size, "Pixels of every output, WIDTHxHEIGHT, instead of the layout's");
    Option* exr = command->add_flag(
        "--exr", options->exr, "Also write an EXR with light, directions, Doppler factor and distance of every pixel");
    Option* pattern = command->add_option("--pattern", options->pattern, pattern_help)->capture_default_str();
    command
        ->add_option(
            "--exposure", options->exposure, "The shot's own exposure (shot), or one metered from the picture (auto)")
        ->check(one_of({"shot", "auto"}))
        ->capture_default_str();
    Option* mode = command
                       ->add_option("--exposure-mode", options->mode,
                           "As an eye sees it (eye), or by one curve that shows everything at once (range)")
                       ->check(one_of({"eye", "range"}))
                       ->capture_default_str();
    Option* bloom = command
                        ->add_option("--bloom", options->bloom,
                            "The share of the light brighter than the screen's white that glows around it, 0 to 1")
                        ->check(number_between(0.0, 1.0))
                        ->capture_default_str();
    Option* spectra = add_spectra(*command, options->spectra);
    Option* quality = command->add_option("--quality", options->quality, quality_help + std::string(" [fine]"));
    Option* points = command->add_option("--measure", options->points, measure_help);
    Option* names = command->add_flag("--sky-names", options->sky_names,
        "With the names of constellations, bright stars and planets, and the constellations' lines");
    Option* overlay
        = command
              ->add_option("--overlay", options->overlay,
                  "With instruments over the picture, and their readings: off, aim, grid, ring (D = 1), distance, "
                  "emission, protractor, spectrum or photometer")
              ->check(one_of(std::vector<std::string>(overlay_names.begin(), overlay_names.end())))
              ->capture_default_str();
    Option* why = command
                      ->add_option("--why", options->why,
                          "With the page that explains one effect: aberration, doppler, headlight, delay, "
                          "dilation or length")
                      ->check(one_of(std::vector<std::string>(why_names.begin(), why_names.end())))
                      ->capture_default_str();
    for (Option* other : {pattern, points, overlay, why})
        names->excludes(other);
    Option* by_eye = command->add_flag("--by-eye", options->by_eye,
        "With --overlay: scales alone, without the instruments' figures, and with --measure the marks alone");
    Option* effects = command->add_option("--effects", options->effects,
        "The effects that are on, instead of the shot's, with commas between them: aberration, doppler, headlight, "
        "false_colours; or none");
    Option* hud = command->add_flag("--hud", options->hud, "With the head-up display");
    const std::vector<std::string_view> displays = names_of(informations);
    command->add_option("--information", options->information, "The head-up display for a visitor, guide or laboratory")
        ->check(one_of(std::vector<std::string>(displays.begin(), displays.end())))
        ->needs(hud)
        ->capture_default_str();
    add_language(*command, options->language);
    Option* replay = command->add_option(
        "--replay", options->replay, "Instead of a shot: a record of starbow run --record, flown again frame by frame");
    for (Option* other :
        {shot, scene, exr, pattern, points, names, overlay, why, mode, by_eye, effects}) // a record has its own mode
        replay->excludes(other);
    Option* frames
        = command->add_option("--frames", options->frames, "With --replay: the frames from A to B, counted from 0, as A:B")
              ->needs(replay);
    Option* every = command->add_option("--every", options->every, "With --replay: every N-th frame")
                        ->check(whole_number(1, 1000000000))
                        ->needs(replay);
    Option* tour = command->add_option("--tour", options->tour,
        "Instead of a shot: a movie of a tour, a file or the name of one in config/tours, as it is shown when nobody flies");
    Option* movie
        = command->add_option("--movie", options->movie, "With --tour or --replay: the movie's file, such as out/tour.mp4");
    for (Option* other : {out, frames, every})
        movie->excludes(other);
    command->add_option("--fps", options->frames_per_s, "With --movie: frames a second")
        ->check(whole_number(1, 240))
        ->capture_default_str()
        ->needs(movie);
    Option* part
        = command
              ->add_option("--part", options->part,
                  "With --movie: draw only the I-th of N parts, as I/N, so that several machines or programs share the "
                  "work; no movie is made")
              ->needs(movie);
    Option* join = command
                       ->add_flag("--join", options->join,
                           "With --movie: make the movie from parts that are all drawn, without a GPU")
                       ->needs(movie)
                       ->excludes(part);
    command->add_option("--others", options->others, "With --join: folders of frames from other machines' disks")
        ->needs(join);
    tour->needs(movie);
    for (Option* other : {shot, scene, out, exr, pattern, replay, points, names, overlay, why, mode, by_eye, effects})
        tour->excludes(other);
    Option* thumbnails = command->add_flag("--thumbnails", options->thumbnails,
        "Instead: draw the small pictures of all worlds, tours and views for the remote's page and the guide's window into "
        "the cache, as far as it lacks them");
    for (Option* other : {shot, scene, out, exr, pattern, replay, tour, points, names, overlay, why, mode, by_eye, effects})
        thumbnails->excludes(other);
    Option* reference = command->add_flag("--reference", options->reference,
        "Trace rays in double precision and with whole spectra, without a GPU: slow, the reference for the other pictures");
    for (Option* other :
        {replay, tour, hud, pattern, bloom, spectra, quality, points, names, overlay, why, mode, by_eye, effects})
        reference->excludes(other);
    command->add_option("--samples", options->samples, "With --reference: rays of each pixel")
        ->check(whole_number(1, 4096))
        ->capture_default_str()
        ->needs(reference);
    command->footer(
        "Examples:\n  starbow render --layout dome --shot avenue-gamma4 --out out/dome --size 2048x2048 --exr\n"
        "  starbow render --layout dome --shot starbow --out out/range --exposure-mode range --hud\n"
        "  starbow render --scene my-world.glb --out out/mine --exposure auto\n"
        "  starbow render --shot gamma100 --out out/right --reference --samples 64\n"
        "  starbow render --replay flight.jsonl --out out/flight --frames 0:599\n"
        "  starbow render --replay flight.jsonl --movie out/flight.mp4 --hud\n"
        "  starbow render --tour first-minute --movie out/first-minute.mp4 --fps 30 --size 1280x720 --language de\n"
        "  starbow render --tour voyage --movie out/voyage.mp4 --part 3/8\n"
        "  starbow render --tour voyage --movie out/voyage.mp4 --join\n"
        "  starbow render --thumbnails\n"
        "  starbow render --shot orion --out out/orion --sky-names --language de\n"
        "  starbow render --shot clocks-passing --out out/clocks --measure \"400,300; 12deg,0deg\" --overlay ring\n"
        "  starbow render --shot clocks-passing --out out/clocks --measure 0deg,0deg --overlay spectrum --by-eye\n"
        "  starbow render --shot avenue-gamma4 --out out/bright --effects aberration,headlight");
    command->callback([options, &chosen] { chosen = [options] { return render(*options); }; });
}

static const Registered render_command{2, add_render};

} // namespace starbow
