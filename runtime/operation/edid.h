#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>

namespace starbow {

/// A monitor's own identity.
struct Edid {
    std::string model; ///< the name that it shows, such as "DELL U2415"; without one, maker and product: "DEL-A0BC"
    std::string serial; ///< the printed serial number, or else its number in decimal; empty where it has neither
    glm::ivec2 size_mm{0}; ///< the picture's size; 0 for projectors
};

/// Parses the first 128 bytes of an EDID (VESA E-EDID 1.4, section 3). nullopt for bytes that are too short, no EDID, or
/// have a wrong checksum: a half-read identity could send a picture to the wrong screen. Letters other than printable ASCII
/// become '?'.
std::optional<Edid> parse_edid(std::span<const std::uint8_t> bytes);

} // namespace starbow
