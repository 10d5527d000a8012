#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "varimap/artifact/artifact.h"
#include "varimap/core/error.h"
#include "varimap/core/lower_case.h"
#include "varimap/core/printable.h"
#include "varimap/mesh_files/obj_model.h"
#include "varimap/mesh_files/text_scanner.h"

namespace varimap {

namespace fs = std::filesystem;

namespace {

std::string with_slashes(std::string path) {
    std::replace(path.begin(), path.end(), '\\', '/');
    return path;
}

/// Statements that name an image.
bool names_image(std::string_view word) {
    return word.starts_with("map_") || word == "bump" || word == "disp" || word == "decal" ||
           word == "refl" || word == "norm";
}

/// Options such as `-s 1 1 1` and `-clamp on` stand in front of the image's name.
bool is_option_value(std::string_view word, std::string_view option) {
    double number;
    return to_number(word, number) || word == "on" || word == "off" || option == "-type" ||
           option == "-imfchan";
}

/// The first word of an image's name, and what the options in front of it say.
struct ImageOptions {
    std::size_t name = 1;
    Vec2 scale = Vec2::Ones(), offset = Vec2::Zero();
};

ImageOptions read_options(const std::vector<std::string_view>& words) {
    ImageOptions options;
    std::size_t& i = options.name;
    while (i + 1 < words.size() && words[i].starts_with('-')) {
        const std::string option = lower_case(words[i++]);
        Vec2* placed = option == "-s" ? &options.scale : option == "-o" ? &options.offset : nullptr;
        for (Eigen::Index axis = 0; i + 1 < words.size() && is_option_value(words[i], option); ++axis, ++i) {
            double number;
            if (placed != nullptr && axis < 2 && to_number(words[i], number) && std::isfinite(number))
                (*placed)[axis] = number;
        }
    }
    return options;
}

class LibraryReader {
  public:
    LibraryReader(std::string path, const ImageNameCheck& is_free, Materials& materials)
        : path_(std::move(path)), is_free_(is_free), materials_(materials) {}

    void read() {
        const std::string bytes = read_file(path_);
        // Plain: names of materials and images may hold #.
        TextScanner scanner(without_byte_order_mark(bytes, path_), path_, LineStyle::plain);
        while (scanner.next_line())
            if (!scanner.words()[0].starts_with('#')) read_line(scanner);
    }

  private:
    void read_line(const TextScanner& scanner) {
        const auto& words = scanner.words();
        const std::string keyword = lower_case(words[0]);
        if (words.size() > 1 && names_image(keyword)) return read_image(scanner, keyword);
        if (keyword == "newmtl") materials_.list.emplace_back().name = scanner.rest_of_line();
        if (words.size() > 1 && !materials_.list.empty()) read_number(scanner, keyword);
        materials_.text += rest(words, 0) + "\n";
    }
    void read_number(const TextScanner& scanner, const std::string& keyword) {
        Material& material = materials_.list.back();
        if (keyword == "kd" && scanner.words().size() > 3)
            material.colour = {scanner.number(1, "red"), scanner.number(2, "green"),
                               scanner.number(3, "blue")};
        // Options, which stand where the number might, are none.
        if (keyword == "d" && is_number(scanner.words()[1])) material.opacity = scanner.number(1, "d");
    }
    void read_image(const TextScanner& scanner, const std::string& keyword) {
        const auto& words = scanner.words();
        const ImageOptions options = read_options(words);
        const std::string name = with_slashes(rest(words, options.name));
        const std::string image = (fs::path(path_).parent_path() / name).string();
        if (!fs::is_regular_file(image))
            throw IoError(fmt::format("{}:{}: the texture {} is missing (looked for at {})", path_,
                                      scanner.line(), printable(name), printable(image)));
        if (keyword == "map_kd" && !materials_.list.empty()) {
            Material& material = materials_.list.back();
            material.texture = image;
            material.texture_scale = options.scale;
            material.texture_offset = options.offset;
        }
        for (std::size_t i = 0; i < options.name; ++i) materials_.text += std::string(words[i]) + " ";
        materials_.text += name_of(image) + "\n";
    }
    /// The image's name beside the MTL file; others of that name get numbers.
    std::string name_of(const std::string& image) {
        const fs::path path(image);
        std::string name = path.filename().string();
        for (int number = 2;; ++number) {
            const auto known = std::find_if(materials_.images.begin(), materials_.images.end(),
                                            [&](const auto& other) { return other.first == name; });
            if (known != materials_.images.end() && known->second == image) return name;
            if (known == materials_.images.end() && is_free_(name, image)) break;
            name = fmt::format("{}-{}{}", path.stem().string(), number, path.extension().string());
        }
        materials_.images.emplace_back(name, image);
        return name;
    }
    static std::string rest(const std::vector<std::string_view>& words, std::size_t from) {
        return {words[from].data(),
                std::size_t(words.back().data() + words.back().size() - words[from].data())};
    }

    std::string path_;
    const ImageNameCheck& is_free_;
    Materials& materials_;
};

/// A library as a file beside the OBJ file; empty where there is none.
std::string library_file(const std::string& library, const std::string& obj_path) {
    for (const std::string& name : {library, with_slashes(library)}) {
        const std::string path = (fs::path(obj_path).parent_path() / name).string();
        if (!name.empty() && fs::is_regular_file(path)) return path;
    }
    return "";
}

/// What `mtllib` names: one file, whose name may hold blanks, or several.
std::vector<std::string> library_files(const std::string& names, const std::string& obj_path) {
    if (const std::string file = library_file(names, obj_path); !file.empty()) return {file};
    std::vector<std::string> files;
    TextScanner scanner(names, obj_path, LineStyle::plain);
    if (scanner.next_line())
        for (const std::string_view name : scanner.words())
            files.push_back(library_file(std::string(name), obj_path));
    if (files.empty() || std::count(files.begin(), files.end(), "") > 0)
        throw IoError(fmt::format("{}: its materials {} are missing (looked for at {})", obj_path,
                                  printable(names),
                                  printable((fs::path(obj_path).parent_path() / names).string())));
    return files;
}

}  // namespace

const Material* Materials::find(const std::string& name) const {
    const auto found =
        std::find_if(list.begin(), list.end(), [&](const Material& other) { return other.name == name; });
    return found == list.end() ? nullptr : &*found;
}

Materials read_materials(const ObjModel& model, const std::string& obj_path, const ImageNameCheck& is_free) {
    Materials materials;
    for (const std::string& library : model.libraries)
        for (const std::string& path : library_files(library, obj_path))
            LibraryReader(path, is_free, materials).read();
    return materials;
}

std::string media_type(std::string_view image) {
    if (image.starts_with("\x89PNG")) return "image/png";
    if (image.starts_with("\xff\xd8\xff")) return "image/jpeg";
    return "";
}

}  // namespace varimap
