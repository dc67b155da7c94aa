#pragma once
#include "config/json/reader.h"
#include "formats.h"
#include <functional>

namespace starbow {

// Shared parts of the readers of warp files.

/// Throws "NAME: PLACE: PROBLEM". By custom the problem is "VALUE is wrong in this way; what would be right".
[[noreturn]] void refuse(const WarpFile& file, const std::string& place, const std::string& problem);

/// A value as messages quote it.
std::string in_quotes(std::string_view text);

/// The whole of a text as a finite number, or nullopt; independent of the locale.
std::optional<double> parsed(std::string_view text);

/// A text file line by line.
class Lines {
public:
    explicit Lines(const WarpFile& file);

    /// Goes to the next line that is not blank; false where there is none.
    bool next();
    /// The same; throws "is missing" where there is none.
    void want(const std::string& what);

    std::string_view text() const { return text_; } ///< without blanks around it
    std::size_t bytes_left() const { return rest_.size(); }

    /// The line's parts between separators, ' ' standing for any run of blanks. Valid until the next call.
    const std::vector<std::string_view>& fields(char separator = ' ');
    /// The same for a given number of parts; otherwise throws with `right`, the line's right form.
    const std::vector<std::string_view>& fields(std::size_t count, const std::string& right, char separator = ' ');

    double number(std::string_view field, Range range) const;
    int integer(std::string_view field, int low, int high) const;

    [[noreturn]] void refuse(const std::string& problem) const;

private:
    const WarpFile& file_;
    std::string_view rest_, text_;
    std::size_t line_ = 0;
    std::vector<std::string_view> fields_;
};

/// The limit of positions in fractions of the viewport, and of places in a picture: farther out the unit must be wrong.
constexpr Range position_range{-100, 100};
constexpr Range picture_range{-10, 10};
/// The same limit in metres.
constexpr Range metre_range{-1e6, 1e6};

/// Most columns or rows of a grid, and most vertices of a mesh.
constexpr int most_grid = 16384;
constexpr std::size_t most_vertices = std::size_t(1) << 26;

/// Makes two triangles for each cell of mesh.grid; those with a hole at a corner are left out. holes: one flag per vertex.
void join_grid(WarpMesh& mesh, const std::vector<char>& holes);

/// Flips a grid whose first row is its lower one, triangles included, so that its rows run from the top.
void rows_from_top(WarpMesh& mesh);

/// A mesh of one vertex per cell's centre, extrapolated by half a cell on each side: else half a cell would stay black.
/// `cells` values, rows from the top; only sees and intensity are used.
WarpMesh centred_mesh(glm::ivec2 cells, const std::vector<WarpVertex>& values, const std::vector<char>& holes);

/// The last step of every reader. Throws where the mesh shows nothing in the viewport. Notes its holes, its folds and how
/// far it reaches beyond the viewport or the picture; warns where all of it shows one direction.
void check_mesh(WarpMesh& mesh, const WarpFile& file);

/// Throws unless left < right, down < up and all lie within 89.9 degrees of the axis.
Sides checked_sides(const WarpFile& file, const std::string& place, const Sides& sides);

/// Reads a map of light from a PNG: 8 or 16 bits, grey or coloured. An alpha channel is dropped; a picture whose colours
/// are all grey becomes one channel. It allocates no memory block larger than most_bytes.
WarpMesh::Mask read_mask(const WarpFile& file, const std::string& place, std::size_t most_bytes);

/// The values of a PFM, rows from the top.
struct FloatMap {
    glm::ivec2 size{0};
    FloatMapForm form;
    std::vector<glm::vec3> values;
};
FloatMap read_float_map(const WarpFile& file, const FloatMapForm& form);

/// The files in an MPCDI archive; unexpected files are refused.
class Archive {
public:
    explicit Archive(const WarpFile& file); ///< a zip
    ~Archive();
    const std::vector<std::string>& names() const { return names_; } ///< of files, not folders
    /// Letters' case in the name does not count.
    std::string contents(const std::string& name, std::size_t most_bytes) const;

private:
    const WarpFile& file_;
    void* zip_ = nullptr;
    std::vector<std::string> names_;
};

/// The largest block of memory that an archive of so many bytes may allocate, and the greatest size of a file in it.
std::size_t most_memory(std::size_t archive_bytes);
std::size_t most_inflated(std::size_t archive_bytes);

/// Gives a file of an archive by its path, of at most most_bytes.
using ArchiveContents = std::function<std::string(const std::string& path, std::size_t most_bytes)>;

/// Parses MPCDI's XML with the files that it names: everything but the unpacking.
WarpMesh mesh_of_mpcdi(const WarpFile& file, const std::string& xml_name, const std::string& xml,
    const ArchiveContents& contents, const std::string& region, const FloatMapForm& form);

/// A map of places in a picture, or of offsets, as a mesh.
WarpMesh place_mesh(const FloatMap& map, const WarpFile& file);

} // namespace starbow
