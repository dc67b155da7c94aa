#pragma once
#include "cube_pass.h"
#include "probe.h"
#include "runtime/world/observer.h"
#include "seen_stars.h"
#include "view_set.h"

namespace starbow {

/// One eye's place, for views of one observer, with the cube map around it.
struct EyeCube {
    glm::dvec3 place_m; ///< in the cockpit, before any head moves
    std::size_t observer; ///< index into EyeCubes::observers
    CubePass cube;
    glm::dvec3 now_m; ///< its place now
    std::vector<EyeEvent> drawn{}; ///< the cube map was drawn at these events, one for each rest frame
    std::vector<StarRun> stars{}; ///< stars that the views may show
    std::vector<RestFrameRequest> requests{};
    std::vector<RestFrameRequest> own_requests{}; ///< those of this machine's outputs; none where it shows all
    std::vector<BoundingCap> caps{}; ///< one for each rest frame: of the drawn surfaces and the filter around them
    std::vector<std::vector<BoundingCap>>
        bodies{}; ///< by rest frame: of its drawn surfaces one by one; none for the world's
    std::vector<EyeEvent> eye_events{}; ///< the cube map would be drawn at these events now
    CubeMapPlan wanted{}; ///< the plan of that cube map
    CubeMapPlan own{}; ///< of own_requests
    std::vector<double> nearest{}; ///< one for each rest frame: a lower bound of its surfaces' distance, scene units; 1
                                   ///< where no distance counts
};

/// The eyes of all views: observers, cube-map plans, and the cube maps themselves.
class EyeCubes {
public:
    EyeCubes(Device& device, Pipelines& pipelines, const GpuWorld& world, FrameState& state, const ViewSet& views,
        SeenStars& stars);

    /// Assigns an eye to each view. Eyes that remain keep their cube maps.
    void assign(std::vector<ViewState>& views);
    /// Forgets all eyes, because their images need other formats.
    void clear();
    void adopt(const Quality& quality);
    /// Gives the images back that are larger than the next plans need; the device must have finished with them.
    void release();
    void repeatable(bool on);
    /// Follows the views' heads.
    void move();

    /// Computes the observers for the instant that is drawn; returns the greatest e^rapidity of any.
    double observe();
    /// The same for the observers of the insets, after observe(), and chooses the cube maps that they are warped from.
    void observe_insets(const std::vector<std::unique_ptr<Inset>>& insets);
    void forget_insets(); ///< there are none any more
    /// The processor's part: plans the cube maps, culls and uploads. pre_exposure applies to cube maps that are drawn
    /// anew. probe: further rays that the probed view's eye must see, or null.
    void plan(double pre_exposure, const Probe* probe);
    /// Draws the cube maps that are not kept from the frame before.
    void record(vk::CommandBuffer commands);
    /// The D below which no light of the view's cube map shows on its screen; 0 where all light counts. pre_exposure: of
    /// the cube map.
    double dark_D(const ViewState& view, double pre_exposure) const;
    void redraw() { drawn_ = false; } ///< the next frame draws all cube maps anew

    const Observer& observer_of(const ViewState& view) const { return observers[view.observer]; }
    /// The least numbers that are exact for an eye's observer.
    StoredLight light_of(std::size_t eye) const;
    /// The rays along each side of a view's pixels.
    int rays_of(const ViewState& view) const;
    /// The directions in which the view may see something that moves.
    void find_bodies(const ViewState& view, std::vector<ShipCap>& bodies) const;
    std::size_t triangles() const; ///< sent to the device for the last frame
    vk::DeviceSize memory() const;

    std::vector<EyeCube> all;
    std::vector<CubeMapPlan> plans; ///< one for each eye
    std::vector<Observer> observers; ///< the views', then the insets'

private:
    std::size_t eye_for(const ViewState& view);
    bool shares_first_eye(const Inset& inset);
    void give_eye(ViewState& view, std::size_t which);
    void keep_inset_eyes(std::size_t count);
    bool looks_closer(const Inset& inset) const;
    bool shares_cube(const Observer& inset, const Observer& first) const;
    StoredLight inset_light(const Observer& inset) const;
    /// Bounds the surfaces of the cube map that is drawn now.
    void bound(EyeCube& eye, const CubeMapPlan& plan) const;
    void request_views(std::size_t eye, double pre_exposure, const Probe* probe);
    bool draws_all() const; ///< outputs of this machine may show every view
    bool can_reuse(std::size_t eye) const;
    double pixel_of(std::size_t eye) const; ///< the angle of a pixel of its views, radians

    Device& device_;
    Pipelines& pipelines_;
    const GpuWorld& world_;
    FrameState& state_;
    const ViewSet& views_;
    SeenStars& stars_;
    std::size_t inset_observers_ = 0; ///< the last of `observers`
    std::size_t inset_eyes_ = 0; ///< the last of `all`, of insets that can share no other cube map
    bool drawn_ = false; ///< the cube maps may be shown once more
    int shown_ = 0; ///< number of frames that have shown them
    PlanScratch scratch_;
};

} // namespace starbow
