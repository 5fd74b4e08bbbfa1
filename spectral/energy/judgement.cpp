#include "spectral/energy/judgement.hpp"

namespace hts::spectral {

bool judged_by_distance(const RoughSurface& surface) noexcept {
    return surface.unified().has_value();
}

Judgement judgement(const ExpectedDistance& expected) noexcept {
    if (!expected.studied) return {Severity::outside, std::nullopt};
    const double distance = expected.distance.unified.unpolarised;
    const Severity severity = distance > greatest_distance ? Severity::outside
                              : distance > fine_distance   ? Severity::caution
                                                           : Severity::fine;
    return {severity, Decibels{distance, distance}};
}

Judgement judgement(const RoughSurface& surface, const DirectionPair& pair, const SpectralSample& sample) {
    if (judged_by_distance(surface)) return judgement(expected_distance(surface, sample, pair.in));
    const Validity assumptions = validity(surface, pair, sample);
    return {assumptions.severity(), decibels(assumptions.error)};
}

}  // namespace hts::spectral
