#pragma once
// A flight in the laboratory, as a student's hands fly it, whose log is written as the program writes it.
#include "runtime/flight/flight.h"
#include "runtime/hud/lab_log.h"
#include "runtime/hud/lab_table.h"
#include "runtime/hud/why.h"
#include "runtime/world/instances.h"
#include "runtime/world/open_scene.h"
#include "runtime/world/world.h"
#include "runtime/world/worldline.h"
#include "tests/support/controls.h"
#include "tests/support/files.h"

namespace starbow::testing {

class LabFlight {
public:
    /// scene: a name in config/scenes. shot: one in config/shots, or empty for the scene's start.
    explicit LabFlight(const std::string& scene, const std::string& shot = "")
        : file_(open_scene(source_dir() / "config/scenes" / (scene + ".json")))
        , world_(load_world(file_))
        , start_(shot.empty() ? file_.start : load_shot(source_dir() / "config/shots" / (shot + ".json")))
        , scene_(scene)
    {
        place_bodies(world_, file_);
        sort_instances(world_);
        rules_.boundary = file_.boundary;
        flight = flight_at(start_, rules_);
    }

    /// Holds the controls for so long, in frames of 1/50 s and less, and writes a line after every `log_every_s`.
    void hold(const Controls& controls, double s, double log_every_s = 0)
    {
        constexpr double frame_s = 0.02;
        for (double left = s; left > 1e-9; left -= frame_s) {
            const double dt = std::min(frame_s, left);
            flight = step(flight, controls, std::llround(1e9 * dt), rules_, file_.seconds_per_time_unit(), start_);
            since_line_s_ += dt;
            if (log_every_s > 0 && since_line_s_ > log_every_s - 1e-9)
                log();
        }
    }
    void wait(double s, double log_every_s = 0) { hold({}, s, log_every_s); }
    /// W for so long: the key gains equal rapidity in equal times.
    void faster(double s) { hold(controls_with(Steering{.throttle_rate = 1}), s); }
    void press(const Controls& controls)
    {
        flight = step(flight, controls, 1'000'000, rules_, file_.seconds_per_time_unit(), start_);
    }
    void look(double left_deg, double up_deg = 0)
    {
        press(controls_with(Looking{.look_rad = {left_deg * pi / 180, up_deg * pi / 180}}));
    }

    void mark(std::size_t which, const Spot& spot)
    {
        if (which == 0)
            marks_ = {}, numbers_ = {};
        marks_[which] = spot, numbers_[which] = ++marked_;
    }
    /// The clock whose middle is nearest to a place of a rest frame.
    Spot clock_near(const glm::dvec3& place, int frame = 0) const
    {
        Spot nearest;
        double least = 1e9;
        const World& w = world_;
        for (std::size_t i = 0; i < w.instances.size(); ++i) {
            if (w.instances[i].frame != frame
                || !w.materials[std::size_t(w.primitives[w.instances[i].primitive].material)].clock)
                continue;
            const Spot spot = snapped({.frame = frame, .clock = i}, w);
            if (const double apart = glm::distance(spot.at, place); apart < least)
                nearest = spot, least = apart;
        }
        EXPECT_LT(least, 2.0) << "no clock is there";
        return nearest;
    }
    int moving_frame() const
    {
        for (std::size_t i = 0; i < world_.frames.size(); ++i)
            if (glm::length(world_.frames[i].u) > 0)
                return int(i);
        ADD_FAILURE() << "nothing moves";
        return 0;
    }

    MeasuringObserver observer() const { return measuring_observer_of(shot_of(flight, scene_)); }
    /// Writes a line; the crosshair is on the sky.
    void log(const std::optional<WrittenReading>& reading = {})
    {
        since_line_s_ = 0;
        const MeasuringObserver now = observer();
        const Spot aim = spot_at(now, {.ray = aim_of(now), .distance = INFINITY}, world_);
        Measured m = measured_of(now, flight.ship, file_, world_, flight.effects, aim, 1, marks_);
        m.mark_numbers = numbers_;
        bytes += log_line(m, "aim", "2026-11-25T08:30:00.000Z", reading) + "\r\n";
    }
    std::vector<LabLine> lines() const { return read_lab_lines(bytes, "flight.csv"); }

    Flight flight;
    std::string bytes = log_header() + "\r\n"; ///< the log

private:
    static constexpr double pi = 3.14159265358979323846;
    SceneFile file_;
    World world_;
    Shot start_;
    std::string scene_;
    Flying rules_;
    std::array<std::optional<Spot>, 2> marks_;
    std::array<long, 2> numbers_{};
    long marked_ = 0;
    double since_line_s_ = 0;
};

} // namespace starbow::testing
