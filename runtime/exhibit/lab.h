#pragma once
#include "runtime/flight/flight.h"
#include "runtime/hud/lab_log.h"
#include "runtime/hud/lab_panel.h"
#include "runtime/render/frame_renderer.h"
#include <chrono>

namespace starbow {

/// All that is measured at one instant. aim: what stands at the crosshair, light: of there, as Probed's.
Measured measured_of(const MeasuringObserver& observer, const Ship& ship, const SceneFile& scene, const World& world,
    const Effects& effects, const Spot& aim, double light, const std::array<std::optional<Spot>, 2>& marks);

/// The instruments of a running exhibit: what their keys have chosen, what was marked, and the log.
class Lab {
public:
    /// log: the CSV file, or empty. every_s: writes by itself so often, 0: never. words: must outlive this. Throws
    /// InputError as LabLog does.
    Lab(const std::filesystem::path& log, double every_s, const Words& words);

    /// What the last frame's probe has seen, which the device must have finished; then the keys. say: for the display.
    void read(const FrameRenderer& frame, const Controls& controls, const GpuWorld& world, double dt_s,
        const std::function<void(std::string)>& say);
    /// What the next frame is to draw and to read.
    void ask(
        FrameRenderer& frame, const Shot& shot, const Flight& flight, const GpuWorld& world, const Typesetter& typesetter);

private:
    bool on() const { return overlay_ != Overlay::off || why_ != Why::none; }
    void keep(const std::function<void(std::string)>& say);

    const Words& words_;
    std::unique_ptr<LabLog> log_;
    double every_s_, waited_s_ = 0;
    Overlay overlay_ = Overlay::off;
    Why why_ = Why::none;
    std::array<std::optional<Spot>, 2> marks_;
    bool mark_wanted_ = false; ///< pressed before anything was seen
    Ship ship_; ///< of the frame that was asked for last
    Effects effects_;
    std::optional<Measured> measured_; ///< as last told
    OverlayScale scale_;
    Panel panel_;
    std::chrono::steady_clock::time_point drawn_{};
};

} // namespace starbow
