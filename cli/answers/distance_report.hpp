/// What `hts info` says of the distance of both theories from exact scattering.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

#include "cli/answers/info_report.hpp"
#include "spectral/energy/judgement.hpp"

namespace hts::cli {

/// The model whose assumptions the criteria of validity judge.
inline constexpr std::string_view judged_model = "he";

/// At a point of the material, in its mirror direction.
[[nodiscard]] spectral::Judgement judgement_at(const MaterialInfo& info,
                                               const spectral::MaterialValidity::Point& point);
/// What stands in place of the criteria: at how many points it is how bad.
[[nodiscard]] std::string distance_verdict(const MaterialInfo& info);
/// Least and greatest expected error over points that are judged by distance, none where one is not studied.
[[nodiscard]] std::optional<spectral::Decibels> unified_distances(
    const MaterialInfo& info, std::span<const spectral::MaterialValidity::Point> points);

/// At a point of the material.
[[nodiscard]] spectral::ExpectedDistance distance_at(const MaterialInfo& info,
                                                     const spectral::MaterialValidity::Point& point);
/// Whether it is studied, and the distances in TE, TM and unpolarised light, as fields.
void add_distance(TableWriter::Row& row, const MaterialInfo& info,
                  const spectral::MaterialValidity::Point& point);
/// A line per angle, the worst over the wavelengths that are studied, and what stands behind it.
[[nodiscard]] std::string distance_text(const MaterialInfo& info);
/// {"cases", …, "by_angle": [{"theta_deg", "studied", "points", "he": {"te", "tm", "unpolarised"}, …,
/// "in_both_directions": null or the nearest solved surface}, …]}
[[nodiscard]] nlohmann::ordered_json distance_json(const MaterialInfo& info);

}  // namespace hts::cli
