#include "validation/scattering/moment_log.hpp"

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "hts/error.hpp"
#include "temporary_folder.hpp"

using namespace hts::validation;

namespace {

MomentSettings small() {
    MomentSettings settings;
    settings.realisations = 20;
    settings.length = 6;
    return settings;
}

const std::vector<LitSurface> two{{{0.2, 1}, {10, 50}}, {{0.1, 1}, {30}}};

bool same(const std::vector<MomentResult>& a, const std::vector<MomentResult>& b) {
    if (a.size() != b.size()) return false;
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (a[i].energy != b[i].energy || a[i].mirror != b[i].mirror || a[i].bins.size() != b[i].bins.size())
            return false;
        for (std::size_t j = 0; j < a[i].bins.size(); ++j) {
            const AngularBin &x = a[i].bins[j], &y = b[i].bins[j];
            if (x.exact != y.exact || x.kirchhoff != y.kirchhoff || x.model != y.model ||
                x.ratio_error_db != y.ratio_error_db || x.theta_r_deg != y.theta_r_deg)
                return false;
        }
    }
    return true;
}

}  // namespace

TEST_CASE("a study that was stopped goes on where it ended, to the same bits, whatever was cut short") {
    const hts::testing::TemporaryFolder folder;
    const std::string path = (folder.path() / "study.unfinished").string();
    const auto whole = moment_results(two, small());
    CHECK(same(moment_results({two[0]}, small(), path), {whole.begin(), whole.begin() + 6}));
    // a line of the second surface that was not finished
    std::ofstream{path, std::ios::app} << "0.10000000000000001 1 0 30 0.5 0.25";
    CHECK(same(moment_results(two, small(), path), whole));
    // and now nothing is solved again: one realisation fewer would be other bits, but is another study
    MomentSettings other = small();
    other.realisations = 21;
    CHECK_THROWS_WITH(
        moment_results(two, other, path),
        path +
            ": is of another run of this study (hts exact scattering 2, 20 realisations 6 long, 10 points of "
            "every 1 drawn, seed 1991); remove it to begin anew");
    CHECK(MomentLog{path, small()}.found({0.1, 1}, {30}).size() == 3);
    CHECK(MomentLog{path, small()}.found({0.1, 1}, {30, 40}).empty());
    CHECK(same(moment_results(two, small(), path), whole));
}
