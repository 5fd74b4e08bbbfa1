#include "validation/pictures/gallery.hpp"

#include <algorithm>
#include <cmath>

#include "validation/pictures/letter.hpp"
#include "validation/pictures/picture.hpp"
#include "validation/pictures/scene_builders.hpp"

namespace hts::validation {

Picture picture_of(const Gallery& gallery, RenderSettings settings, const Progress& progress) {
    const std::vector<Scene> scenes = gallery.scenes();
    const std::size_t gap = gallery.columns > 1 ? std::max<std::size_t>(1, settings.width / 150) : 0;
    settings.width =
        std::max<std::size_t>(1, (settings.width - (gallery.columns - 1) * gap) / gallery.columns);
    settings.height = static_cast<std::size_t>(
        std::max(1L, std::lround(gallery.height_over_width * static_cast<double>(settings.width))));
    const auto count = static_cast<double>(scenes.size());
    const bool lettered = gallery.caption.find("(a)") != std::string::npos;
    std::vector<Picture> pictures;
    for (const Scene& scene : scenes) {
        const auto before = static_cast<double>(pictures.size());
        pictures.push_back(render(scene, settings, [&](double share) {
            if (progress) progress((before + share) / count);
        }));
        if (lettered) put_letter(pictures.back(), pictures.size() - 1);
    }
    return panels(pictures, gallery.columns, gap);
}

Rectangle softbox(Vector3 centre, Vector3 looks_at, double width, double height) {
    const Frame frame = Frame::about(normalised(looks_at - centre), cross({0, 0, 1}, looks_at - centre));
    return {centre - (width / 2) * frame.x - (height / 2) * frame.y, width * frame.x, height * frame.y};
}

const std::vector<Gallery>& galleries() {
    static const std::vector<Gallery> all = [] {
        std::vector<Gallery> list = he_galleries();
        for (const Gallery& gallery : microfacet_galleries()) list.push_back(gallery);
        return list;
    }();
    return all;
}

}  // namespace hts::validation
