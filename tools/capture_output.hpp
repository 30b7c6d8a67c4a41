#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "capture/capture_bounds.hpp"
#include "capture/capture_search.hpp"

namespace ballbot {

/// All that a capture is and found; `edges` is empty where only the bound was asked for.
struct CaptureFindings {
  CaptureRequest request;
  BoundRequest bound_request;
  std::vector<CaptureBound> bounds;  ///< as captureBounds() orders them
  std::vector<CaptureEdge> edges;
};

/// What `--json` prints, but for what the study behind it adds.
nlohmann::ordered_json captureJson(const CaptureFindings& findings);
/// The same for people: a table for each duration and height.
std::string captureText(const CaptureFindings& findings);

}  // namespace ballbot
