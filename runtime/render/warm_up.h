#pragma once
#include "frame_renderer.h"
#include <functional>

namespace starbow {

/// Draws, off-screen, a frame for each state of the switches that a visitor can reach, so that no frame in flight waits for
/// a compiler: effects, comparisons, false colours, overlays and test patterns, at rest and in flight. Software renderers
/// compile when they draw, so frames are drawn and not only pipelines made; a state that needs no new pipeline is not drawn.
/// A software renderer takes a tenth of a second for each pipeline: there, combinations of a comparison or false colours
/// with effects switched off are left out and compiled when they come.
///
/// frame: a renderer for this alone, whose switches are left anyhow. shot: the start, whose world is warmed up. hud: a
/// panel, or null. format: of the outputs' targets. qualities: those that may come. progress: is called with the states done
/// and their number. Returns the number of pipelines.
std::size_t warm_up(Device& device, Pipelines& pipelines, FrameRenderer& frame, const Shot& shot, const Panel* hud,
    vk::Format format, std::span<const Quality> qualities, const std::function<void(std::size_t, std::size_t)>& progress);

} // namespace starbow
