#pragma once
#include "frame_renderer.h"
#include <functional>

namespace starbow {

/// Draws, off-screen, a frame for each state of the switches that a visitor can reach, so that no frame in flight waits
/// for a compiler. The states are effects, comparisons, false colours, overlays and test patterns, at rest and in flight.
/// Software renderers compile when they draw, so frames are drawn and not only pipelines made. A state that needs no new
/// pipeline is not drawn. A software renderer takes a tenth of a second for each pipeline. It therefore leaves out
/// combinations of a comparison or false colours with effects switched off; they are compiled at their first use.
///
/// frame: a renderer for this purpose alone; its switches are left in any state. shot: the start, whose world is warmed
/// up, in its quality. hud: a panel, or null. format: of the outputs' targets. progress: is called with the number of
/// finished states and of all states. Returns the number of pipelines. Throws NoRoom.
std::size_t warm_up(Device& device, Pipelines& pipelines, FrameRenderer& frame, const Shot& shot, const Panel* hud,
    vk::Format format, const std::function<void(std::size_t, std::size_t)>& progress);

} // namespace starbow
