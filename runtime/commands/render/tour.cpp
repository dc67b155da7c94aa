#include "tour.h"
#include "config/json/error.h"
#include "config/model/shipped.h"
#include "runtime/commands/options/size.h"
#include "runtime/exhibit/tour_renderer.h"
#include "runtime/flight/record.h"
#include "runtime/flight/tour_film.h"
#include "runtime/render/render_context.h"
#include "runtime/world/open_scene.h"

namespace starbow {
namespace {

/// The text that a frame shows over the world.
std::string text_of(const Caption& caption)
{
    std::string all = caption.text;
    for (const std::string& choice : caption.choices)
        all += '\n' + choice;
    return all;
}

/// A highlight, as text.
std::string text_of(const Highlight& highlight)
{
    std::string all
        = highlight.name + '\n' + highlight.body + '\n' + highlight.globe + (highlight.enlarged ? "\nenlarged" : "\n");
    for (const double number : {highlight.at.x, highlight.at.y, highlight.at.z, highlight.across})
        all += ' ' + std::to_string(number);
    return all;
}

/// A digest of the states and texts of all frames: where it is equal, so are they.
std::uint64_t digest_of_frames(const Show& show, long frames_per_s, const Words& words)
{
    TourFilm film(show, frames_per_s);
    std::uint64_t shown = digest(std::string_view());
    for (long i = 0; i < film.frames(); ++i) {
        const Touring& touring = film.at(i);
        const std::uint64_t flight = digest(touring.flight);
        shown = digest({reinterpret_cast<const char*>(&flight), sizeof flight}, shown);
        shown = digest(text_of(caption_of(touring, show, words, {})), shown);
        shown = digest(title_of(touring, show), shown);
        for (const Highlight& highlight : show.tour.steps[touring.step()].highlights)
            shown = digest(text_of(highlight), shown);
    }
    return shown;
}

} // namespace

int render_tour(const TourOptions& options)
{
    if (options.film.movie.empty())
        throw InputError("--tour is given without --movie; the movie's file, such as out/tour.mp4, is right");
    const Words words = words_in(options.language);
    const Layout layout = layout_in_size(options.layout, options.size);
    const Tour tour = seen_on(tour_in(options.tour, words), layout.surrounds);
    const std::filesystem::path scene = scene_of(tour);
    const SceneFile opened = open_scene(scene);
    check_highlights(tour, opened);
    check_film(options.film, layout);
    const Show show{tour, {}, opened.seconds_per_time_unit(), false};
    TourFilm states(show, options.film.frames_per_s);
    const auto film_on = [&](const std::string& device) {
        return Filming(options.film, layout, scene, words, states.frames(), device,
            {{"tour", tour.file.stem().string()},
                {"states", shown_digest(digest_of_frames(show, options.film.frames_per_s, words))},
                {"bloom", options.bloom}});
    };
    if (options.film.joins)
        return film_on("").join();
    RenderContext context(scene, device_options(false));
    Filming film = film_on(context.device.name());

    OffscreenRenderer renderer(
        context.device, context.pipelines, context.world, layout, default_quality(context.device, true), false);
    TourRenderer tour_renderer(renderer, show, context.world, words);
    tour_renderer.bloom(options.bloom);
    for (long i = 0; i < states.frames(); ++i)
        if (!film.take([&] { return tour_renderer.picture(states.at(i)); }))
            break;
    const int status = film.finish();
    return status != 0 || context.device.complaints.empty() ? status : 1;
}

} // namespace starbow
