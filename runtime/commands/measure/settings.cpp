#include "settings.h"
#include "config/json/hash.h"
#include "config/json/kept_file.h"
#include "config/json/reader.h"
#include "runtime/commands/median.h"
#include "runtime/operation/progress.h"
#include "runtime/reference/number_errors.h"
#include "runtime/render/offscreen.h"
#include "runtime/render/pass_timer.h"
#include "shaders/physics/physics.h"
#include <chrono>
#include <cmath>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>
#include <unistd.h>

namespace starbow {
namespace {

/// One output of one shot as it should be.
struct Truth {
    std::vector<std::uint8_t> picture;
    Reference all;
};
using Truths = std::vector<std::vector<Truth>>; // of each shot, of each output

Truths truths_of(const Trial& trial)
{
    const ReferenceWorld world = open_reference_world(trial.scene);
    Truths truths;
    for (const auto& [name, shot] : trial.shots) {
        std::vector<Truth>& of_shot = truths.emplace_back();
        for (std::size_t output = 0; output < trial.layout.outputs.size(); ++output) {
            const Output& own = trial.layout.outputs[output];
            Progress progress;
            ReferenceOptions options;
            options.samples = trial.samples;
            options.kept = trial.folder / ("reference-" + name + "-" + own.name + ".rows");
            options.progress = [&](int done, int all) {
                progress.show("reference of " + name + ", " + own.name + ": " + std::to_string(done) + " of "
                        + std::to_string(all) + " rows",
                    double(done) / all);
            };
            Reference truth = reference(world.input(), trial.layout, shot, output, options);
            std::vector<std::uint8_t> picture = shown(truth);
            of_shot.push_back({std::move(picture), std::move(truth)});
        }
    }
    return truths;
}

/// The shot so many frames of a sixtieth of a second on board earlier.
Shot earlier(const Shot& shot, int frames, double seconds_per_time_unit)
{
    const double passed = frames / 60.0 / seconds_per_time_unit;
    Shot before = shot;
    before.position -= shot.u * passed;
    before.time -= physics::gamma_of(shot.u) * passed;
    return before;
}

/// One render context for each level of light that is tried.
class RenderContexts {
public:
    RenderContexts(std::filesystem::path scene, Device::Options options)
        : scene_(std::move(scene))
        , options_(std::move(options))
    {
    }
    RenderContext& with(std::optional<SpectralLevel> level)
    {
        std::unique_ptr<RenderContext>& context = made_[level];
        if (!context)
            context = std::make_unique<RenderContext>(scene_, options_, level);
        return *context;
    }

private:
    std::filesystem::path scene_;
    Device::Options options_;
    std::map<std::optional<SpectralLevel>, std::unique_ptr<RenderContext>> made_;
};

/// A quality's frames, off-screen.
struct Drawer {
    Device& device;
    OffscreenRenderer renderer;
    int block; ///< frames, after which all is as before

    Drawer(RenderContext& context, const Layout& layout, const Quality& quality)
        : device(context.device)
        , renderer(context.device, context.pipelines, context.world, layout, within(context.device, quality), false)
        , block(quality.frames_per_cube)
    {
    }
    double mean_ms(const Shot& shot)
    {
        double sum = 0;
        for (int i = 0; i < block; ++i)
            sum += PassTimer(device, renderer).frame(shot);
        return sum / block;
    }
};

/// Its time of each shot, each frame beside one of the standard's.
void time(const Trial& trial, RenderContext& context, RenderContext& standards, MeasuredSetting& one, double& standard_ms)
{
    Drawer own(context, trial.layout, one.setting.quality), standard(standards, trial.layout, trial.standard);
    one.ms = standard_ms = 0;
    double ratios = 0;
    for (const auto& [name, shot] : trial.shots) {
        std::vector<double> mine, its;
        for (int round = -1; round < trial.rounds; ++round) {
            const double a = own.mean_ms(shot), b = standard.mean_ms(shot);
            if (round >= 0)
                mine.push_back(a), its.push_back(b);
        }
        const double count = double(trial.shots.size());
        one.ms += median(mine) / count, standard_ms += median(its) / count;
        ratios += std::log(median(mine) / median(its)) / count;
        double texels = 0, pixels = 0;
        int images = 0;
        for (const CubeMapPlan& plan : own.renderer.frame().plans())
            texels += plan.texels, pixels += plan.pixels, images += int(plan.images.size());
        one.texels_per_pixel = std::max(one.texels_per_pixel, texels / pixels);
        one.images = std::max(one.images, images);
    }
    one.ratio = std::exp(ratios);
    one.megabytes = double(own.renderer.frame().memory()) / (1 << 20);
}

void find_errors(const Trial& trial, RenderContext& context, const Truths& truths, MeasuredSetting& one)
{
    const Quality quality = within(context.device, one.setting.quality);
    double noise = 0, count = 0;
    std::vector<double> directions, dopplers;
    one.errors = {};
    for (std::size_t i = 0; i < trial.shots.size(); ++i) {
        const Shot& shot = trial.shots[i].second;
        OffscreenRenderer renderer(context.device, context.pipelines, context.world, trial.layout, quality, false);
        if (quality.frames_per_cube > 1)
            (void)renderer.picture(earlier(shot, quality.frames_per_cube - 1, context.world.scene.seconds_per_time_unit()));
        const auto pictures = renderer.picture(shot);
        OffscreenRenderer measured(context.device, context.pipelines, context.world, trial.layout, quality, true);
        directions.clear(), dopplers.clear();
        for (std::size_t output = 0; output < pictures.size(); ++output) {
            const Truth& truth = truths[i][output];
            const PictureErrors errors = picture_errors({truth.all.size, pictures[output]}, {truth.all.size, truth.picture});
            noise += std::pow(10, -errors.psnr_dB / 10);
            one.errors.flip += errors.flip;
            one.errors.ciede2000_mean += errors.ciede2000_mean;
            one.errors.ciede2000_95 += errors.ciede2000_95;
            one.errors.edges_95_px = std::max(one.errors.edges_95_px, errors.edges_95_px);
            ++count;
            const NumberErrors numbers = number_errors(truth.all, measured.numbers(shot, output), shot.u);
            directions.insert(directions.end(), numbers.directions_px.begin(), numbers.directions_px.end());
            dopplers.insert(dopplers.end(), numbers.doppler.begin(), numbers.doppler.end());
        }
        one.direction_px = std::max(one.direction_px, quantile(directions, 0.99));
        one.doppler = std::max(one.doppler, quantile(dopplers, 0.99));
    }
    one.errors.psnr_dB = -10 * std::log10(noise / count);
    one.errors.flip /= count;
    one.errors.ciede2000_mean /= count;
    one.errors.ciede2000_95 /= count;
}

/// What an interrupted run had measured.
class Kept {
public:
    Kept(std::filesystem::path file, const std::string& key)
        : file_(std::move(file))
    {
        ContentHash hash;
        hash.add(key.data(), key.size());
        key_ = hash.value();
        KeptFile before(file_, kind, key_);
        std::string text(before.size(0), '\0');
        if (before.read({bytes_of(text)}))
            settings_ = nlohmann::json::parse(text);
    }
    bool find(MeasuredSetting& one) const
    {
        const auto at = settings_.find(quality_text(one.setting.quality));
        if (at == settings_.end())
            return false;
        const std::vector<double> v = at->get<std::vector<double>>();
        one.ms = v.at(0), one.ratio = v.at(1), one.megabytes = v.at(2), one.texels_per_pixel = v.at(3),
        one.images = int(v.at(4));
        one.errors = {v.at(5), v.at(6), v.at(7), v.at(8), v.at(9)};
        one.direction_px = v.at(10), one.doppler = v.at(11);
        return true;
    }
    void keep(const MeasuredSetting& one)
    {
        const PictureErrors& e = one.errors;
        settings_[quality_text(one.setting.quality)]
            = {one.ms, one.ratio, one.megabytes, one.texels_per_pixel, one.images, std::min(e.psnr_dB, 1e3), e.flip,
                e.ciede2000_mean, e.ciede2000_95, e.edges_95_px, one.direction_px, one.doppler};
        write_kept(file_, kind, key_, {bytes_of(settings_.dump())});
    }
    void forget() const
    {
        std::error_code ignored;
        std::filesystem::remove(file_, ignored);
    }

private:
    static constexpr const char* kind = "measure2";
    std::filesystem::path file_;
    std::uint64_t key_ = 0;
    nlohmann::json settings_ = nlohmann::json::object();
};

std::string key_of(const Trial& trial, const std::string& machine)
{
    std::string key
        = machine + "," + std::to_string(trial.rounds) + "," + std::to_string(trial.samples) + quality_text(trial.standard);
    for (const std::filesystem::path& file : {trial.scene, trial.layout.file})
        key += read_document(file).text;
    for (const Output& output : trial.layout.outputs)
        key += "," + std::to_string(output.size.x) + "x" + std::to_string(output.size.y);
    for (const auto& [name, shot] : trial.shots)
        key += "," + name;
    return key;
}

} // namespace

std::vector<MeasuredSetting> measure_settings(
    const Trial& trial, const std::vector<Setting>& settings, const Device::Options& options, std::string& machine)
{
    RenderContexts theatres(trial.scene, options);
    RenderContext& standards = theatres.with(trial.standard.spectra);
    machine = standards.device.name();
    const Truths truths = truths_of(trial);
    Kept kept(trial.folder / "measured.kept", key_of(trial, machine));
    std::vector<MeasuredSetting> all;
    std::vector<double> standard_ms;
    Progress progress;
    for (const Setting& setting : settings) {
        MeasuredSetting one{setting};
        if (!kept.find(one)) {
            progress.show(
                "setting " + std::to_string(all.size() + 1) + " of " + std::to_string(settings.size()) + ": " + setting.name,
                double(all.size()) / double(settings.size()));
            RenderContext& context = theatres.with(setting.quality.spectra);
            double beside = 0;
            time(trial, context, standards, one, beside);
            find_errors(trial, context, truths, one);
            kept.keep(one);
        }
        standard_ms.push_back(one.ms / one.ratio);
        all.push_back(one);
    }
    // The machine's speed drifts, ratios hardly: all times are stated for its usual speed.
    if (!standard_ms.empty())
        for (MeasuredSetting& one : all)
            one.ms = one.ratio * quantile(standard_ms, 0.5);
    kept.forget();
    return all;
}

double time_ratio(const Trial& trial, const Quality& one, const Quality& other, const Device::Options& options)
{
    RenderContexts theatres(trial.scene, options);
    Trial pair = trial;
    pair.standard = other;
    MeasuredSetting measured{{.name = {}, .quality = one}};
    double other_ms = 0;
    time(pair, theatres.with(one.spectra), theatres.with(other.spectra), measured, other_ms);
    return measured.ratio;
}

} // namespace starbow
