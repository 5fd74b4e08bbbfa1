/// What `hts info` says of the distance of both theories from exact scattering.
#pragma once

#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

#include "cli/answers/info_report.hpp"
#include "spectral/energy/expected_distance.hpp"

namespace hts::cli {

/// The model whose assumptions the criteria of validity judge.
inline constexpr std::string_view judged_model = "he";

/// At a point of the material.
[[nodiscard]] spectral::ExpectedDistance distance_at(const MaterialInfo& info,
                                                     const spectral::MaterialValidity::Point& point);
/// Whether it is studied, and the distances in TE, TM and unpolarised light, as fields.
void add_distance(TableWriter::Row& row, const MaterialInfo& info,
                  const spectral::MaterialValidity::Point& point);
/// A line per angle, the worst over the wavelengths that are studied, and what stands behind it.
[[nodiscard]] std::string distance_text(const MaterialInfo& info);
/// {"studied_points", "points", "cases", …, "by_angle": [{"theta_deg", "he": {"te",
/// "tm", "unpolarised"}, …}, …]}
[[nodiscard]] nlohmann::ordered_json distance_json(const MaterialInfo& info);

}  // namespace hts::cli
