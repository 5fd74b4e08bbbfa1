#include "validation/scattering/moment_log.hpp"

#include <filesystem>
#include <fstream>
#include <sstream>
#include <utility>

#include "hts/error.hpp"
#include "spectral/text/decimal.hpp"

namespace hts::validation {
namespace {

std::string number(double value) {
    std::string text;
    spectral::append_17_digits(text, value);
    return text;
}

std::string key(const RoughnessStatistics& surface, double theta_i_deg) {
    return number(surface.rms_roughness) + ' ' + number(surface.correlation_length) + ' ' +
           number(surface.nu.value_or(0)) + ' ' + number(theta_i_deg);
}

std::string head(const MomentSettings& settings) {
    std::string text = "hts exact scattering 2, " + std::to_string(settings.realisations) + " realisations " +
                       number(settings.length) + " long, " + std::to_string(settings.points_per_wavelength) +
                       " points of every " + std::to_string(settings.drawn_between) + " drawn, seed " +
                       std::to_string(settings.study);
    if (settings.index)
        text += ", index " + number(settings.index->n()) + " + i " + number(settings.index->k());
    return text;
}

/// The numbers of a result, written or read.
template <class Result, class Visit>
void for_numbers(Result& result, const Visit& visit) {
    for (auto* value :
         {&result.energy, &result.mirror, &result.past_ends, &result.transmitted, &result.kirchhoff_energy})
        visit(*value);
    for (auto& bin : result.bins) {
        for (auto* value : {&bin.theta_r_deg, &bin.exact, &bin.kirchhoff, &bin.ratio_error_db}) visit(*value);
        for (auto& value : bin.model) visit(value);
    }
}

}  // namespace

MomentLog::MomentLog(std::string path, const MomentSettings& settings)
    : path_{std::move(path)}, settings_{settings} {
    if (path_.empty()) return;
    std::ifstream file{path_};
    std::string line;
    if (!std::getline(file, line)) {
        std::ofstream{path_} << head(settings) << '\n';
        return;
    }
    if (line != head(settings))
        throw Error{path_ + ": is of another run of this study (" + line + "); remove it to begin anew"};
    auto sound = file.tellg();
    while (std::getline(file, line) && line.ends_with(" .") && !file.eof()) {
        sound = file.tellg();
        std::istringstream in{line};
        MomentCase of{{}, 0, {}, settings.index};
        double nu = 0;
        in >> of.surface.rms_roughness >> of.surface.correlation_length >> nu >> of.theta_i_deg;
        if (nu > 0) of.surface.nu = nu;
        std::vector<MomentResult> three;
        for (const Polarisation polarisation : polarisations) {
            of.polarisation = polarisation;
            constexpr auto bins = static_cast<std::size_t>(180 / bin_width_deg);
            MomentResult result{of, settings.realisations, 0, 0, 0, 0, 0, std::vector<AngularBin>(bins)};
            for_numbers(result, [&in](double& value) { in >> value; });
            three.push_back(std::move(result));
        }
        solved_[key(of.surface, of.theta_i_deg)] = std::move(three);
    }
    file.close();
    std::filesystem::resize_file(path_,
                                 static_cast<std::uintmax_t>(sound));  // a line that was cut short goes
}

std::vector<MomentResult> MomentLog::found(const RoughnessStatistics& surface,
                                           const std::vector<double>& theta_i_deg) const {
    std::vector<MomentResult> all;
    for (const double theta : theta_i_deg) {
        const auto three = solved_.find(key(surface, theta));
        if (three == solved_.end()) return {};
        all.insert(all.end(), three->second.begin(), three->second.end());
    }
    return all;
}

void MomentLog::add(const std::vector<MomentResult>& results) {
    if (path_.empty()) return;
    std::ofstream file{path_, std::ios::app};
    for (std::size_t i = 0; i + 2 < results.size(); i += 3) {
        const std::string name = key(results[i].of.surface, results[i].of.theta_i_deg);
        file << name;
        for (std::size_t j = i; j < i + 3; ++j)
            for_numbers(results[j], [&file](double value) { file << ' ' << number(value); });
        file << " .\n";
        solved_[name] = {results.begin() + static_cast<std::ptrdiff_t>(i),
                         results.begin() + static_cast<std::ptrdiff_t>(i + 3)};
    }
    if (!file.flush()) throw Error{path_ + ": cannot be written"};
}

}  // namespace hts::validation
