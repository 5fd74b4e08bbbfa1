#include "table_fixture.hpp"

namespace hts::tables::testing {

const TableJob& small_job() {
    static const TableJob job = [] {
        TableSource source;
        source.name = "rough aluminium";
        source.material = R"({"name": "rough aluminium", "model": "he", "rms_roughness_um": 0.28, )"
                          R"("correlation_length_um": 1.77, "index": "Al",
             "diffuse_albedo": 0.1})";
        source.material_path = "rough.json";
        return TableJob{source, {0.45, 0.55, 0.65}, {.tolerance = 3e-2, .polarised = true}};
    }();
    return job;
}

const spectral::Reflectance& small_exact() {
    static const auto exact = exact_model(small_job());
    return exact;
}

const std::string& small_bytes() {
    static const std::string bytes =
        finished_table(small_exact(), small_job().source, plan_table(small_exact(), small_job().request),
                       computed_slices(small_exact()));
    return bytes;
}

const Table& small_table() {
    static const Table table = Table::from_bytes(small_bytes(), "small");
    return table;
}

}  // namespace hts::tables::testing
