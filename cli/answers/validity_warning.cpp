#include "cli/answers/validity_warning.hpp"

#include <iostream>

namespace hts::cli {

using spectral::Severity;

void ValidityWarning::note(const spectral::Validity& verdict) noexcept {
    ++count_;
    if (verdict.severity() != Severity::outside) return;
    ++outside_;
    for (const spectral::Finding& finding : verdict.findings) {
        if (finding.severity() == Severity::outside)
            broken_[static_cast<std::size_t>(finding.criterion)] = true;
    }
}

void ValidityWarning::note(const spectral::Reflectance& reflectance, const DirectionPair& pair) {
    gain_.note(reflectance, pair.in);
    const auto& surface = reflectance.properties().surface;
    if (!surface) return;
    for (const SpectralSample& sample : reflectance.samples())
        note(spectral::validity(*surface, pair, sample));
}

void ValidityWarning::print(const std::string& source) const {
    gain_.print(source);
    if (outside_ == 0) return;
    std::cerr << "hts: " << outside_ << " of " << count_ << " values " << (count_ == 1 ? "is" : "are")
              << " outside the model's validity (" << criteria() << "): see hts info\n";
}

std::string ValidityWarning::criteria() const {
    std::string names;
    for (std::size_t i = 0; i < broken_.size(); ++i) {
        if (!broken_[i]) continue;
        names.append(names.empty() ? "" : ", ").append(name(static_cast<spectral::Criterion>(i)));
    }
    return names;
}

}  // namespace hts::cli
