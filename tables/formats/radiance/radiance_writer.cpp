#include <string>
#include <string_view>
#include <vector>

#include "hts/error.hpp"
#include "spectral/text/text.hpp"
#include "tables/formats/channels.hpp"
#include "tables/formats/points/tokens.hpp"
#include "tables/formats/radiance/radiance_xml.hpp"

namespace hts::tables {
namespace {

std::string escaped(std::string_view text) {
    std::string result;
    for (const char character : text) {
        switch (character) {
            case '&':
                result += "&amp;";
                break;
            case '<':
                result += "&lt;";
                break;
            case '>':
                result += "&gt;";
                break;
            default:
                result += character;
        }
    }
    return result;
}

// A channel of a file.
struct Channel {
    std::string name;      // "Visible"
    std::string detector;  // which of the 1931 observer's curves
    std::string data;
};

std::string definition_of(const KlemsBasis& basis) {
    std::string text = "<AngleBasis>\n<AngleBasisName>";
    text.append(escaped(basis.name())).append("</AngleBasisName>\n");
    for (const KlemsBasis::Ring& ring : basis.rings()) {
        text.append("<AngleBasisBlock><Theta>").append(shortest((ring.low + ring.high) / 2));
        text.append("</Theta><nPhis>")
            .append(std::to_string(ring.patches))
            .append("</nPhis><ThetaBounds><LowerTheta>");
        text.append(shortest(ring.low)).append("</LowerTheta><UpperTheta>").append(shortest(ring.high));
        text.append("</UpperTheta></ThetaBounds></AngleBasisBlock>\n");
    }
    return text + "</AngleBasis>\n";
}

std::string document(const std::string& name, std::string_view structure, std::string_view definitions,
                     std::string_view bases, const std::vector<Channel>& channels) {
    std::string text = R"(<?xml version="1.0" encoding="UTF-8"?>
<WindowElement xmlns="http://windows.lbl.gov">
<WindowElementType>System</WindowElementType>
<FileType>BSDF</FileType>
<Optical>
<Layer>
<Material>
<Name>)";
    text.append(escaped(name)).append(R"(</Name>
<Manufacturer>hts</Manufacturer>
<DeviceType>Other</DeviceType>
</Material>
<DataDefinition>
<IncidentDataStructure>)");
    text.append(structure)
        .append("</IncidentDataStructure>\n")
        .append(definitions)
        .append("</DataDefinition>\n");
    for (const Channel& channel : channels) {
        text.append(R"(<WavelengthData>
<LayerNumber>System</LayerNumber>
<Wavelength unit="Integral">)");
        text.append(channel.name).append(R"(</Wavelength>
<SourceSpectrum>CIE Illuminant D65 1nm.ssp</SourceSpectrum>
<DetectorSpectrum>ASTM E308 1931 )");
        text.append(channel.detector).append(R"(.dsp</DetectorSpectrum>
<WavelengthDataBlock>
<WavelengthDataDirection>Reflection Back</WavelengthDataDirection>
)");
        text.append(bases).append(R"(<ScatteringDataType>BRDF</ScatteringDataType>
<ScatteringData>
)");
        text.append(channel.data).append(R"(
</ScatteringData>
</WavelengthDataBlock>
</WavelengthData>
)");
    }
    text.append(R"(</Layer>
</Optical>
</WindowElement>
)");
    return text;
}

}  // namespace

std::string klems_xml(const spectral::Reflectance& brdf, const KlemsBasis& basis, bool specular) {
    if (brdf.size() != 3 && brdf.size() != 1)
        throw out_of_range("number of channels", static_cast<double>(brdf.size()), "", "1, or 3 of a colour");
    const auto all = klems_means(brdf, basis, specular);
    const auto data = [&](std::size_t channel) {
        const std::vector<double>& means = all[channel];
        std::string text;
        for (std::size_t i = 0; i < means.size(); ++i) {
            append_rounded(text, means[i]);
            text += (i + 1) % basis.size() == 0 ? '\n' : ' ';
        }
        return text;
    };
    std::vector<Channel> channels;
    if (brdf.size() == 3) {
        channels = {{"CIE-X", "X", data(2)}, {"Visible", "Y", data(1)}, {"CIE-Z", "Z", data(0)}};
    } else {
        channels = {{"Visible", "Y", data(0)}};
    }
    std::string bases = "<ColumnAngleBasis>";
    bases.append(escaped(basis.name()))
        .append("</ColumnAngleBasis>\n<RowAngleBasis>")
        .append(escaped(basis.name()));
    bases += "</RowAngleBasis>\n";
    const bool known = basis.name() == KlemsBasis::full().name();
    return document(brdf.name(), "Columns", known ? "" : definition_of(basis), bases, channels);
}

std::string tensor_tree_xml(const spectral::Reflectance& brdf, const TensorTreeOptions& options) {
    const std::string_view structure = brdf.properties().isotropic ? "TensorTree3" : "TensorTree4";
    std::vector<Channel> channels;
    if (brdf.size() == 3) {
        TensorTreeOptions fine = options;  // the eye sees 0.004 in u' or v'
        fine.merge /= 4;
        const auto chromaticity = chromaticity_of_tristimulus(brdf);
        channels = {{"Visible", "Y", tensor_tree_text(brdf_at(brdf, 1), options)},
                    {"CIE-u", "u", tensor_tree_text(brdf_at(chromaticity, 0), fine)},
                    {"CIE-v", "v", tensor_tree_text(brdf_at(chromaticity, 1), fine)}};
    } else {
        channels = {{"Visible", "Y", tensor_tree_text(brdf, options)}};
    }
    return document(brdf.name(), structure, "", "<AngleBasis>LBNL/Shirley-Chiu</AngleBasis>\n", channels);
}

}  // namespace hts::tables
