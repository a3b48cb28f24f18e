// SPDX-License-Identifier: Apache-2.0
// The test files of the Khronos glTF validator, each with the report that the validator gives for it.
#include "support.h"

#include <algorithm>
#include <fstream>

namespace gnomon::scene::test {
namespace {

namespace fs = std::filesystem;

/// Errors of the validator that do not touch geometry, materials, images, skins, animation, cameras or lights as we
/// read them. A file is exempt from being refused only when every one of its errors is here.
struct Exemption {
    std::string_view code;
    std::string_view pointer_part; // the error's pointer contains this
    std::string_view reason;
};
constexpr Exemption kExempt[] = {
    {"VALUE_NOT_IN_RANGE", "/extensions/KHR_materials_anisotropy/", "an extension that has no effect here"},
    {"VALUE_NOT_IN_RANGE", "/extensions/KHR_materials_dispersion/", "an extension that has no effect here"},
    {"UNSATISFIED_DEPENDENCY", "/extensions/KHR_materials_variants/", "an extension that has no effect here"},
    {"UNDEFINED_PROPERTY", "/extensions/KHR_materials_variants", "an extension that has no effect here"},
    {"TYPE_MISMATCH", "/extensions/KHR_materials_variants/", "an extension that has no effect here"},
    {"MESH_PRIMITIVE_NO_TANGENT_SPACE", "/material",
     "only anisotropy and clear coat need tangents without a normal map, and neither has an effect here"},
    {"SCENE_NON_ROOT_NODE", "/scenes/", "where a node is follows from the tree, whatever a scene names"},
    {"NODE_SKIN_NO_SCENE", "/nodes/", "joints come along with what they move"},
    {"ACCESSOR_MIN_MISMATCH", "/accessors/", "the data count"},
    {"ACCESSOR_MAX_MISMATCH", "/accessors/", "the data count"},
    {"ACCESSOR_ELEMENT_OUT_OF_MIN_BOUND", "/accessors/", "the data count"},
    {"ACCESSOR_ELEMENT_OUT_OF_MAX_BOUND", "/accessors/", "the data count"},
    {"ACCESSOR_NON_CLAMPED", "", "colours are clamped as the specification asks for"},
    {"BUFFER_VIEW_TARGET_OVERRIDE", "", "what a view is used for says what its data are"},
    {"ANIMATION_SAMPLER_ACCESSOR_WITH_BYTESTRIDE", "", "the stride is obeyed"},
    {"SKIN_IBM_ACCESSOR_WITH_BYTESTRIDE", "", "the stride is obeyed"},
    {"IO_ERROR", "/images/", "textures do without an image that is not there"},
    {"IMAGE_BUFFER_VIEW_WITH_BYTESTRIDE", "", "an image has no use for a stride"},
};

struct Problem {
    std::string code;
    std::optional<std::string> pointer;
};

bool isExempt(const Problem& problem)
{
    return std::any_of(std::begin(kExempt), std::end(kExempt), [&](const Exemption& e) {
        return problem.code == e.code && problem.pointer && problem.pointer->find(e.pointer_part) != std::string::npos;
    });
}

std::vector<Problem> errorsOf(const fs::path& report)
{
    std::ifstream stream(report);
    const json parsed = json::parse(stream);
    std::vector<Problem> out;
    for (const json& message : parsed.at("issues").at("messages")) {
        if (message.at("severity") == 0) {
            Problem problem{message.at("code"), {}};
            if (message.contains("pointer")) {
                problem.pointer = message.at("pointer").get<std::string>();
            }
            out.push_back(problem);
        }
    }
    return out;
}

std::vector<fs::path> corpus()
{
    std::vector<fs::path> files;
    const fs::path folder = sharedFolder("corpus");
    if (folder.empty()) {
        return files;
    }
    constexpr std::string_view kEnd = ".report.json";
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
        const std::string path = entry.path().string();
        if (path.ends_with(kEnd)) {
            files.emplace_back(path.substr(0, path.size() - kEnd.size()));
        }
    }
    std::sort(files.begin(), files.end());
    return files;
}

/// The pointer in "... at POINTER: found ..."; "byte N ..." for what comes before the JSON; empty when there is none.
std::string placeIn(const std::string& message)
{
    const std::size_t at = message.rfind(" at ", message.find(": found"));
    return at == std::string::npos ? std::string() : message.substr(at + 4, message.find(": found", at) - at - 4);
}

/// One names the other or something within it.
bool related(std::string a, std::string b)
{
    a = a == "/" ? "" : a;
    b = b == "/" ? "" : b;
    const std::string& shorter = a.size() < b.size() ? a : b;
    const std::string& longer = a.size() < b.size() ? b : a;
    return shorter == longer || (!shorter.empty() && longer.starts_with(shorter + "/"));
}

void expectRefused(const fs::path& file, const std::vector<Problem>& problems)
{
    const std::string message = errorOfFile(file);
    EXPECT_EQ(message.find('\n'), std::string::npos);
    EXPECT_NE(message.find(file.string()), std::string::npos) << message;
    const std::string place = placeIn(message);
    const bool consistent = std::any_of(problems.begin(), problems.end(), [&](const Problem& problem) {
        // A fault of the container has no pointer; an empty file has no place at all.
        return problem.pointer ? related(*problem.pointer, place)
                               : place.starts_with("byte ") || message.find("the file is empty") != std::string::npos;
    });
    EXPECT_TRUE(consistent) << message;
}

TEST(GltfCorpus, RefusesWhatMattersAndLoadsTheRest)
{
    const std::vector<fs::path> files = corpus();
    if (files.empty()) {
        GTEST_SKIP() << "NO CORPUS: set GNOMON_SHARED to the folder that has corpus/";
    }
    EXPECT_GE(files.size(), 185U);
    std::size_t refused = 0;
    for (const fs::path& file : files) {
        SCOPED_TRACE(file.string());
        const std::vector<Problem> problems = errorsOf(file.string() + ".report.json");
        if (!problems.empty() && !std::all_of(problems.begin(), problems.end(), isExempt)) {
            expectRefused(file, problems);
            ++refused;
            continue;
        }
        EXPECT_NO_THROW({
            const Scene scene = readGltf(file);
            static_cast<void>(evaluate(scene, 0.25));
        });
    }
    EXPECT_GT(refused, 100U) << "the reports could not be read";
}

} // namespace
} // namespace gnomon::scene::test
