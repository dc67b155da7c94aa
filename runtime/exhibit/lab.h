#pragma once
#include "runtime/flight/flight.h"
#include "runtime/hud/lab_entry.h"
#include "runtime/hud/lab_log.h"
#include "runtime/hud/lab_panel.h"
#include "runtime/hud/lab_plot.h"
#include "runtime/machines/picture_state.h"
#include "runtime/render/frame_renderer.h"
#include <chrono>

namespace starbow {

/// The instruments of a running exhibit: the chosen overlay and page, the marks, and the log.
class Lab {
public:
    /// log: the CSV file, or empty. every_s: interval of automatic lines, 0: none. by_eye: the instruments have scales
    /// alone, and the key of the log asks for the student's reading. words: must outlive this. Throws InputError as LabLog
    /// does.
    Lab(const std::filesystem::path& log, double every_s, bool by_eye, const Words& words);

    /// Reads the last frame's probe, which the device must have finished, then applies the keys. say: receives messages
    /// for the display.
    void read(const FrameRenderer& frame, Switches pressed, const GpuWorld& world, double dt_s,
        const std::function<void(std::string)>& say);
    /// The next frame's overlay, panel and probes; none: no instrument is on. The panel lasts until the next call.
    std::optional<Instruments> request(
        const ViewSet& views, const Shot& shot, const Flight& flight, const GpuWorld& world, const Typesetter& typesetter);

    /// True while a student writes a reading down: the keys are the number's.
    bool writes() const { return entry_ && entry_->open(); }
    /// Keys as LabEntry takes them.
    void type(std::string_view keys);

    /// True where an instrument, a page or a mark is on.
    bool shows_anything() const { return on() || marks_[0] || marks_[1]; }
    /// Another world: its marks and readings are gone.
    void forget()
    {
        marks_ = {}, mark_numbers_ = {}, measured_.reset(), entry_.reset(), said_.clear(), marks_due_ = lines_due_ = 0;
    }
    /// Another visitor: the instruments are off, as at the start.
    void reset() { forget(), overlay_ = Overlay::off, why_ = Why::none, plot_ = Plot::none; }

private:
    bool on() const { return overlay_ != Overlay::off || why_ != Why::none || plot_ != Plot::none; }
    void keep(const std::function<void(std::string)>& say);
    void keep_line(
        const Measured& measured, const std::optional<WrittenReading>& reading, const std::function<void(std::string)>& say);
    void keep_reading(const std::function<void(std::string)>& say);
    double aspect() const;
    void add_to_plots(std::string_view text, long number);
    Panel draw_panel(const Typesetter& typesetter, int width) const;

    const Words& words_;
    std::unique_ptr<LabLog> log_;
    double every_s_, waited_s_ = 0;
    bool by_eye_;
    std::optional<LabEntry> entry_; ///< open, or just written
    std::string said_; ///< about the last reading, until the next one
    Overlay overlay_ = Overlay::off;
    Why why_ = Why::none;
    Plot plot_ = Plot::none;
    std::array<std::vector<PlotPoint>, plot_names.size()> points_; ///< of each plot, from the log's lines
    std::optional<LabLine> last_line_;
    std::array<std::optional<Spot>, 2> marks_;
    std::array<long, 2> mark_numbers_{};
    long marks_made_ = 0;
    int marks_due_ = 0, lines_due_ = 0; ///< presses that wait for the first probe
    Ship ship_; ///< the ship of the frame requested last
    Effects effects_;
    std::optional<Measured> measured_; ///< the last readings
    OverlayScale scale_;
    Panel panel_;
    std::int64_t panel_number_; ///< Instruments'
    std::chrono::steady_clock::time_point drawn_{};
};

} // namespace starbow
