#include "hts/surface.hpp"

#include "hts/error.hpp"
#include "hts/wavelength.hpp"

namespace hts {

Surface::Surface(double rms_roughness, double correlation_length)
    : rms_roughness_{rms_roughness}, correlation_length_{correlation_length} {
    const bool rough = rms_roughness >= shortest_length && rms_roughness <= longest_length;
    if (!rough && rms_roughness != 0) {
        throw out_of_range("rms roughness", rms_roughness, "um", ">= 0 (0, or from 1e-24 to 1e+24 um)");
    }
    if (!(correlation_length >= shortest_length && correlation_length <= longest_length)) {
        throw out_of_range("correlation length", correlation_length, "um", "> 0 (from 1e-24 to 1e+24 um)");
    }
}

}  // namespace hts
