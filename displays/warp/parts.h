#pragma once
#include "config/json/reader.h"
#include "formats.h"
#include <functional>

namespace starbow {

// What the readers of warp files share.

/// Throws "NAME: PLACE: PROBLEM". By custom the problem is "VALUE is wrong in this way; what would be right".
[[noreturn]] void refuse(const WarpFile& file, const std::string& place, const std::string& problem);

/// A value as messages quote it.
std::string in_quotes(std::string_view text);

/// The whole of a text as a finite number, or nothing; independent of the locale.
std::optional<double> parsed(std::string_view text);

/// A text file line by line.
class Lines {
public:
    explicit Lines(const WarpFile& file);

    /// Goes to the next line that is not blank; false where there is none.
    bool next();
    /// Goes there too; throws "is missing" where there is none.
    void want(const std::string& what);

    std::string_view text() const { return text_; } ///< without blanks around it
    std::size_t bytes_left() const { return rest_.size(); }

    /// The line's parts between separators, ' ' standing for any run of blanks. Valid until the next call.
    const std::vector<std::string_view>& fields(char separator = ' ');
    /// The same, if there are so many; throws with `right`, what a line should be, otherwise.
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

/// Positions in fractions of the viewport, and places in a picture: farther out than this something else is meant.
constexpr Range position_range{-100, 100};
constexpr Range picture_range{-10, 10};
/// Metres.
constexpr Range metre_range{-1e6, 1e6};

/// Most columns or rows of a grid, and most vertices of a mesh.
constexpr int most_grid = 16384;
constexpr std::size_t most_vertices = std::size_t(1) << 26;

/// Two triangles for each cell of mesh.grid; those with a hole at a corner are left out. holes: one flag per vertex.
void join_grid(WarpMesh& mesh, const std::vector<char>& holes);

/// Turns a grid whose first row is its lower one about, triangles and all, so that its rows run from the top.
void rows_from_top(WarpMesh& mesh);

/// A mesh of one vertex per cell's centre, and half a cell wider on each side, where it goes on as straight as it arrives:
/// else half a cell would stay black. `cells` values, rows from the top; only sees and intensity are used.
WarpMesh centred_mesh(glm::ivec2 cells, const std::vector<WarpVertex>& values, const std::vector<char>& holes);

/// What every reader ends with: throws where the mesh shows nothing in the viewport; notes its holes, its folds and how far
/// it reaches beyond the viewport or the picture.
void check_mesh(WarpMesh& mesh, const WarpFile& file);

/// Throws unless left < right, down < up and all lie within 89.9 degrees of the axis.
Sides checked_sides(const WarpFile& file, const std::string& place, const Sides& sides);

/// A map of light in a PNG: 8 or 16 bits, grey or coloured; an alpha channel is dropped, and colours that are all grey
/// become one channel. No memory block larger than most_bytes is asked for.
WarpMesh::Mask read_mask(const WarpFile& file, const std::string& place, std::size_t most_bytes);

/// The values of a PFM, rows from the top.
struct FloatMap {
    glm::ivec2 size{0};
    bool first_row_on_top = false; ///< in the file
    std::vector<glm::vec3> values;
};
FloatMap read_float_map(const WarpFile& file, bool first_row_on_top);

/// The files in an MPCDI archive; what is not there is refused.
class Archive {
public:
    explicit Archive(const WarpFile& file); ///< a zip
    ~Archive();
    const std::vector<std::string>& names() const { return names_; } ///< of files, not folders
    /// Whether the name's letters are capital or small does not count.
    std::string contents(const std::string& name, std::size_t most_bytes) const;

private:
    const WarpFile& file_;
    void* zip_ = nullptr;
    std::vector<std::string> names_;
};

/// The largest block of memory that an archive of so many bytes may ask for, and the most that a file in it may grow to.
std::size_t most_memory(std::size_t archive_bytes);
std::size_t most_inflated(std::size_t archive_bytes);

/// What MPCDI's XML makes of the files that `contents` gives by their paths: all but the unpacking.
WarpMesh mesh_of_mpcdi(const WarpFile& file, const std::string& xml_name, const std::string& xml,
    const std::function<std::string(const std::string& path, std::size_t most_bytes)>& contents, const std::string& region,
    bool first_row_on_top);

/// A map of places in a picture as a mesh; see README.md for the one that holds offsets instead.
WarpMesh place_mesh(const FloatMap& map, const WarpFile& file);

} // namespace starbow
