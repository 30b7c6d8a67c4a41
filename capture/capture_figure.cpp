#include "capture/capture_figure.hpp"

#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "report/svg_polar.hpp"

namespace ballbot {
namespace {

constexpr double kGap = std::numeric_limits<double>::quiet_NaN();
// The curves of what was survived get the other colours.
constexpr int kBoundColour = 0, kVariantColours = 5;

void addBounds(SvgPolar& axes, const CaptureRequest& request, const BoundRequest& wanted,
               const std::vector<CaptureBound>& bounds, std::size_t duration, std::size_t height) {
  const std::size_t durations = request.durations_s.size(), heights = request.heights_m.size();
  std::vector<const CaptureBound*> drawn;
  for (std::size_t v = 0; v < request.variants.size(); ++v) {
    const CaptureBound& b = bounds[(v * durations + duration) * heights + height];
    bool there = false;
    for (const CaptureBound* d : drawn) there = there || d->known_N == b.known_N;
    if (there) continue;
    drawn.push_back(&b);
    const std::string of = v == 0 ? "" : " (" + request.variants[v].label + ")";
    axes.curves.push_back(
        {"bound, push known" + of, kBoundColour, false, false, b.angle_deg, b.known_N});
    axes.curves.push_back({fmt::format("bound, blind for {:g} ms{}", 1e3 * wanted.blind_s, of),
                           kBoundColour, true, false, b.angle_deg, b.blind_N});
  }
}

}  // namespace

std::string captureFigure(const CaptureRequest& request, const BoundRequest& bound_request,
                          const std::vector<CaptureEdge>& edges,
                          const std::vector<CaptureBound>& bounds) {
  std::vector<SvgPolar> all;
  for (std::size_t d = 0; d < request.durations_s.size(); ++d) {
    for (std::size_t h = 0; h < request.heights_m.size(); ++h) {
      SvgPolar axes;
      axes.title = fmt::format("{:g} s at {:g} m", request.durations_s[d], request.heights_m[h]);
      axes.unit = "N";
      axes.x_name = "x, forward";
      axes.y_name = "y, to the left";
      addBounds(axes, request, bound_request, bounds, d, h);
      for (std::size_t v = 0; v < request.variants.size(); ++v) {
        SvgPolarCurve curve{request.variants[v].label,
                            1 + static_cast<int>(v) % kVariantColours,
                            false,
                            true,
                            {},
                            {}};
        for (const CaptureEdge& e : edges) {
          if (e.variant != v || e.duration != d || e.height != h) continue;
          curve.angle_deg.push_back(request.directionDeg(e.direction));
          curve.radius.push_back(e.survived_N.value_or(kGap));
          curve.low.push_back(e.boundary.low.value_or(kGap));
          curve.high.push_back(e.boundary.high.value_or(kGap));
        }
        axes.curves.push_back(std::move(curve));
      }
      all.push_back(std::move(axes));
    }
  }
  return svgPolarFigure("Largest push survived, by direction", all);
}

}  // namespace ballbot
