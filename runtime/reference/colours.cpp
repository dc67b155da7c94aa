#include "colours.h"
#include <algorithm>
#include <cmath>

namespace starbow {
namespace {

constexpr int steps_per_octave = 1024, most_octaves = 34; // D up to that of gamma = 1e9 and more, either way
constexpr int rows = 2 * most_octaves * steps_per_octave + 2;
const glm::dvec3 luminance(0.2126, 0.7152, 0.0722); // Rec. 709

double mean(const glm::dvec3& v) { return (v.x + v.y + v.z) / 3; }

} // namespace

ByShift::ByShift(int colours, Sum sum, bool kept)
    : colours_(colours)
    , sum_(std::move(sum))
    , rows_(kept ? new std::atomic<const glm::dvec3*>[std::size_t(rows)]() : nullptr)
{
}

ByShift::~ByShift()
{
    for (int i = 0; rows_ && i < rows; ++i)
        delete[] rows_[std::size_t(i)].load();
}

const glm::dvec3* ByShift::row(int i) const
{
    std::atomic<const glm::dvec3*>& kept = rows_[std::size_t(i)];
    if (const glm::dvec3* known = kept.load(std::memory_order_acquire))
        return known;
    auto made = std::make_unique<glm::dvec3[]>(std::size_t(colours_));
    sum_(std::exp2(double(i) / steps_per_octave - most_octaves), made.get());
    const glm::dvec3* other = nullptr;
    // The second thread takes the first one's, which is the same.
    return kept.compare_exchange_strong(other, made.get(), std::memory_order_acq_rel) ? made.release() : other;
}

void ByShift::at(double D, glm::dvec3* seen) const
{
    const double at = (std::log2(D) + most_octaves) * steps_per_octave;
    if (!rows_ || !(at >= 0 && at < rows - 1))
        return sum_(D, seen);
    const int i = int(at);
    const glm::dvec3 *low = row(i), *high = row(i + 1);
    for (int k = 0; k < colours_; ++k)
        seen[k] = glm::mix(low[k], high[k], at - i);
}

glm::dvec3 ByShift::at(double D) const
{
    glm::dvec3 seen;
    at(D, &seen);
    return seen;
}

Colours::Colours(const World& world, const SceneFile& scene, const StandardObserver& observer)
    : world_(world)
    , observer_(observer)
    , material_of_set_(1, -1)
{
    for (std::size_t i = 0; i < world.materials.size(); ++i) {
        const Material& material = world.materials[i];
        set_.push_back(material.reflectance.empty() ? 0 : int(material_of_set_.size()));
        if (!material.reflectance.empty())
            material_of_set_.push_back(int(i));
        emissions_.push_back(material.emission ? emission(*material.emission) : nullptr);
        amounts_.push_back(material.emission ? law_of(*material.emission).sunlit_part : 0);
        glows_.push_back(material.temperature_K > 0 ? emission(BlackBody{material.temperature_K}) : nullptr);
    }
    if (scene.sky.temperature_K > 0)
        sky_glow_ = emission(BlackBody{scene.sky.temperature_K});
    kind({});
}

std::unique_ptr<ByShift> Colours::emission(const Emission& emission) const
{
    const EmissionLaw law = law_of(emission);
    return std::make_unique<ByShift>(
        1, [this, law](double D, glm::dvec3* out) { *out = observer_.rec709 * seen(observer_, law, D); }, law.smooth);
}

/// The number of a surface's reflectances that are summed separately.
int Colours::parts(int material) const { return material < 0 ? 5 : 1; }

/// material -1: of base colours.
std::function<double(double nm)> Colours::reflectance(int material, int part) const
{
    if (material >= 0)
        return Reflectance{world_.materials[std::size_t(material)].reflectance};
    glm::dvec3 rgb(0);
    if (part < 3)
        rgb[part] = 1;
    return [=](double nm) { return base_reflectance(rgb, part == 3, part == 4, nm); };
}

void Colours::sum(const Kind& kind, int material, double D, glm::dvec3* out) const
{
    // Spectral radiance per frequency: the surface has at a wavelength what the lamp has at D times that, and the eye what
    // the surface has.
    const EmissionLaw law = kind.light ? law_of(*kind.light) : EmissionLaw{.spectrum = sunlit_white()};
    for (int i = 0; i < parts(material); ++i) {
        const auto reflects = reflectance(material, i);
        if (law.is_line()) {
            out[i]
                = observer_.rec709 * seen(observer_, law, kind.D * D) * (law.sunlit_part * reflects(law.line_nm / kind.D));
            continue;
        }
        const Spectrum reflected = [&](double nm) { return law.sunlit_part * law.spectrum(nm * kind.D) * reflects(nm); };
        out[i] = observer_.rec709 * seen(observer_, reflected, D);
    }
}

std::size_t Colours::kind(const Kind& kind)
{
    const auto at = std::find(kinds_.begin(), kinds_.end(), kind);
    if (at != kinds_.end())
        return std::size_t(at - kinds_.begin());
    kinds_.push_back(kind);
    seen_.emplace_back();
    const bool smooth = !kind.light || law_of(*kind.light).smooth;
    for (int material : material_of_set_)
        seen_.back().push_back(std::make_unique<ByShift>(
            parts(material), [=, this](double D, glm::dvec3* out) { sum(kind, material, D, out); }, smooth));
    return kinds_.size() - 1;
}

Colours::Amounts Colours::amounts(int index, const glm::dvec3& base, const glm::dvec3& light) const
{
    const glm::dvec3 lit = base * light;
    if (index >= 0 && set_[std::size_t(index)] > 0)
        return {glm::dot(luminance, lit), 0, 0, 0, 0};
    const double all = mean(lit);
    if (index < 0)
        return {lit.r, lit.g, lit.b, all, all};
    const Material& material = world_.materials[std::size_t(index)];
    return {lit.r, lit.g, lit.b, material.ultraviolet ? *material.ultraviolet * mean(light) : all,
        material.infrared ? *material.infrared * mean(light) : all};
}

glm::dvec3 Colours::lit(int material, std::size_t kind, const glm::dvec3& base, const glm::dvec3& light, double D) const
{
    const int set = material < 0 ? 0 : set_[std::size_t(material)];
    std::array<glm::dvec3, 5> each;
    seen_[kind][std::size_t(set)]->at(D, each.data());
    const Amounts of = amounts(material, base, light);
    glm::dvec3 all(0);
    for (int i = 0; i < parts(material_of_set_[std::size_t(set)]); ++i)
        all += each[std::size_t(i)] * of[std::size_t(i)];
    return all;
}

glm::dvec3 Colours::lit(int material, const Kind& kind, const glm::dvec3& base, const glm::dvec3& light, double D) const
{
    const int own = material_of_set_[std::size_t(material < 0 ? 0 : set_[std::size_t(material)])];
    std::array<glm::dvec3, 5> each;
    sum(kind, own, D, each.data());
    const Amounts of = amounts(material, base, light);
    glm::dvec3 all(0);
    for (int i = 0; i < parts(own); ++i)
        all += each[std::size_t(i)] * of[std::size_t(i)];
    return all;
}

glm::dvec3 Colours::sent(int index, const glm::dvec3& emitted, double D) const
{
    const Material& material = world_.materials[std::size_t(index)];
    glm::dvec3 all(0);
    if (emissions_[std::size_t(index)])
        all += emissions_[std::size_t(index)]->at(D) * (amounts_[std::size_t(index)] * glm::dot(luminance, emitted));
    else if (emitted != glm::dvec3(0))
        all += lit(-1, sunlight, emitted, glm::dvec3(1), D);
    if (glows_[std::size_t(index)])
        all += glows_[std::size_t(index)]->at(D) * material.emissivity;
    return all;
}

glm::dvec3 Colours::sky(const glm::dvec3& colour, double D) const
{
    const glm::dvec3 all = lit(-1, sunlight, colour, glm::dvec3(1), D);
    return sky_glow_ ? all + sky_glow_->at(D) : all;
}

glm::dvec3 Colours::star(double kelvin, double D) const
{
    const double at_rest = seen_xyz(black_body(kelvin), 1).y;
    return observer_.rec709 * seen(observer_, black_body(kelvin), D) / at_rest;
}

} // namespace starbow
