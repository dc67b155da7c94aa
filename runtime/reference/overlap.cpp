#include "overlap.h"
#include <algorithm>
#include <numeric>
#include <set>

namespace starbow {

BlendResult laid_over(const std::vector<BlendLayer>& coats, bool plain)
{
    std::set<int> orders;
    for (const BlendLayer& coat : coats)
        orders.insert(coat.order);
    BlendResult out;
    std::vector<double> parts(coats.size(), 0);
    for (int order : orders) {
        glm::dvec3 hidden(0), added(0);
        double part_hidden = 0;
        for (const BlendLayer& coat : coats)
            if (coat.order == order) {
                hidden += coat.mask;
                added += coat.mask * coat.brightness * coat.screen;
                part_hidden += (coat.mask.r + coat.mask.g + coat.mask.b) / 3;
            }
        out.screen = out.screen * (1.0 - glm::min(hidden, 1.0)) + added;
        for (std::size_t i = 0; i < coats.size(); ++i)
            if (coats[i].order < order)
                parts[i] *= 1 - std::min(part_hidden, 1.0);
            else if (coats[i].order == order)
                parts[i] = (coats[i].mask.r + coats[i].mask.g + coats[i].mask.b) / 3;
    }
    const auto above
        = [&](std::size_t a, std::size_t b) { return std::pair(coats[a].order, a) > std::pair(coats[b].order, b); };
    for (std::size_t i = 1; i < coats.size(); ++i)
        if (parts[i] > parts[out.foremost] || (parts[i] == parts[out.foremost] && above(i, out.foremost)))
            out.foremost = i;
    const double sum = std::accumulate(parts.begin(), parts.end(), 0.0);
    if (plain) {
        out.screen = sum > 0 ? glm::dvec3(0) : coats[out.foremost].screen;
        for (std::size_t i = 0; sum > 0 && i < coats.size(); ++i)
            out.screen += coats[i].screen * (parts[i] / sum);
    }
    return out;
}

} // namespace starbow
