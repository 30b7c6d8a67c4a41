#pragma once

#include <string>
#include <vector>

#include "capture/capture_bounds.hpp"
#include "capture/capture_search.hpp"

namespace ballbot {

/// The forces survived and their bounds over direction, as an SVG picture: one pair of polar axes
/// for each duration and height, one curve for each variant.
std::string captureFigure(const CaptureRequest& request, const BoundRequest& bound_request,
                          const std::vector<CaptureEdge>& edges,
                          const std::vector<CaptureBound>& bounds);

}  // namespace ballbot
