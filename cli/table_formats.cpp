#include "cli/table_formats.hpp"

#include "tables/pbsdf.hpp"
#include "tables/rgl.hpp"

namespace hts::cli {
namespace {

tables::Sidecar write_rgl(const tables::SpectralBrdf& brdf, const std::string& path) {
    return tables::write_rgl(brdf, path);
}

tables::Sidecar write_pbsdf(const tables::SpectralBrdf& brdf, const std::string& path) {
    return tables::write_pbsdf(brdf, path);
}

}  // namespace

const std::vector<TableFormat>& table_formats() {
    static const std::vector<TableFormat> formats{
        {"rgl", "tensor .bsdf of spectra, for Mitsuba 3, pbrt-v4 and powitacq; isotropic", "0.38:0.78:21",
         write_rgl, tables::read_rgl},
        {"pbsdf", "Mueller matrices at five wavelengths, for Mitsuba 3; isotropic, model he", "0.45:0.65:5",
         write_pbsdf, tables::read_pbsdf},
    };
    return formats;
}

}  // namespace hts::cli
