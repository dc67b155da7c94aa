#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace starbow {

/// A picture as shown: sRGB, rows from the top, four bytes a pixel (red, green, blue, unused).
struct Shown8 {
    glm::ivec2 size;
    std::span<const std::uint8_t> rgba;
};

/// The errors of a picture against a reference of the same size.
struct PictureErrors {
    double psnr_dB; ///< peak signal (255) to noise, of all three colours together; infinite where nothing differs
    double flip; ///< mean of LDR-FLIP, 0 to 1
    double ciede2000_mean, ciede2000_95; ///< mean and 95th percentile over the pixels, white being Rec. 709's
    double edges_95_px; ///< 95th percentile of the edges' displacements, pixels; 0 without edges
};
PictureErrors picture_errors(const Shown8& picture, const Shown8& reference);

/// Peak signal-to-noise ratio, dB.
double psnr_dB(const Shown8& picture, const Shown8& reference);

/// LDR-FLIP of each pixel, 0 to 1: Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström, Fairchild, "FLIP: A Difference
/// Evaluator for Alternating Images", Proc. ACM Comput. Graph. Interact. Tech. 3(2), 2020. pixels_per_degree: 67 is the
/// paper's, of a person 0.7 m from a screen of 0.7 m and 3840 pixels.
std::vector<double> flip(const Shown8& picture, const Shown8& reference, double pixels_per_degree = 67);

/// The displacement of each edge of the reference in the picture, pixels, across the edge where the luminance is steepest.
/// It is found by least squares over 7 x 7 pixels (Lucas and Kanade 1981).
std::vector<double> edge_displacements_px(const Shown8& picture, const Shown8& reference);

/// The part-quantile of values, linear between the nearest two; 0 without values.
double quantile(std::vector<double> values, double part);

} // namespace starbow
