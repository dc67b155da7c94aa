#pragma once
#include "runtime/machines/picture_state.h"
#include "runtime/render/frame_renderer.h"
#include "thumbnails.h"
#include <map>

namespace starbow {

/// A plate with some words, drawn anew only where its words or its size are others.
class Plate {
public:
    /// draw: returns the panel of these lines in this size.
    template <class Draw> const Panel& of(const std::vector<std::string>& lines, double size, const Draw& draw)
    {
        if (lines != lines_ || size != size_)
            panel_ = draw(), lines_ = lines, size_ = size;
        return panel_;
    }

private:
    Panel panel_;
    std::vector<std::string> lines_;
    double size_ = 0;
};

/// A title over the middle of the views' picture. plate: the same for one title after another.
Callout title_over(const ViewSet& views, const Typesetter& typesetter, const std::string& title, Plate& plate);

/// Sets a frame renderer up for one picture after another, and draws the panels of their texts.
class PictureSetup {
public:
    /// read: makes the small pictures of a menu's choices, on a thread; empty: there are none.
    explicit PictureSetup(std::function<Thumbnails()> read = {})
        : thumbnails_(std::move(read))
    {
    }
    /// The device must have finished the frame before. Returns the head-up display's panel, or null.
    const Panel* set_up(const PictureState& now, const Words& words, FrameRenderer& frame);
    /// Another world, layout or quality: an inset may have room now.
    void forget() { no_room_ = false; }

    /// A text's panel, `width` pixels wide; it is drawn anew only where the text or the width is another one.
    const Panel* panel_of(const HudText& hud, const Words& words, int width);
    const Panel* panel() const { return panel_.size.x > 0 ? &panel_ : nullptr; } ///< the last one; null before the first

    Typesetter typesetter;

private:
    struct WantedInset;

    void place(const PictureState& now, FrameRenderer& frame);
    void place_sky_labels(const std::vector<SkyLabel>& labels, const ViewSet& views, double degree_px);
    void place_highlights(const std::vector<ShownHighlight>& highlights, const ViewSet& views, double degree_px);
    std::vector<WantedInset> wanted_insets(const PictureState& now);
    bool place_small_picture(const PictureState& now, const ViewSet& views);
    void place_insets(const PictureState& now, FrameRenderer& frame, double degree_px);
    void place_inset(const WantedInset& inset, std::size_t which, double aside, double half_x, const FrameRenderer& frame,
        double degree_px);

    ThumbnailReader thumbnails_;
    Panel panel_;
    std::int64_t drawn_ = -1; ///< HudText::number
    Plate title_, sign_, pointer_;
    std::map<std::string, Plate> sky_names_;
    std::array<Plate, 2> rings_, names_; ///< of highlights, and of insets
    static constexpr double line_degree_px = 16;
    Panel line_ = draw_line(line_degree_px); ///< stretched to its length
    bool no_room_ = false; ///< for an inset
    std::vector<Callout> callouts_;
};

} // namespace starbow
