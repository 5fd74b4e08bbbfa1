/// What a study of exact scattering has solved, in a file, so that one that was stopped goes on where it
/// ended. Private to `moment_method`.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "validation/scattering/moment_method.hpp"

namespace hts::validation {

/// Text: a line that names the settings, then a line per surface and angle of
/// incidence, which ends with a dot.
class MomentLog {
  public:
    ///   path   hts::Error where the file is of other settings; nothing is read or written if it is empty
    MomentLog(std::string path, const MomentSettings& settings);

    /// Results of a surface at all the angles, as moment_results gives them; none if one of them lacks.
    [[nodiscard]] std::vector<MomentResult> found(const RoughnessStatistics& surface,
                                                  const std::vector<double>& theta_i_deg) const;
    void add(const std::vector<MomentResult>& results);

  private:
    std::string path_;
    MomentSettings settings_;
    std::map<std::string, std::vector<MomentResult>> solved_;  // by surface and angle: TE, TM and unpolarised
};

}  // namespace hts::validation
