#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "varimap/artifact/artifact.h"
#include "varimap/core/error.h"
#include "varimap/core/printable.h"
#include "varimap/mesh/io/obj_model.h"
#include "varimap/mesh/io/text_scanner.h"

namespace varimap {

namespace fs = std::filesystem;

namespace {

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

/// Index of the first word of the image's name.
std::size_t image_word(const std::vector<std::string_view>& words) {
    std::size_t i = 1;
    while (i + 1 < words.size() && words[i].starts_with('-')) {
        const std::string_view option = words[i++];
        while (i + 1 < words.size() && is_option_value(words[i], option)) ++i;
    }
    return i;
}

class LibraryReader {
  public:
    LibraryReader(std::string path, Materials& materials) : path_(std::move(path)), materials_(materials) {}

    void read() {
        const std::string bytes = read_file(path_);
        TextScanner scanner(without_byte_order_mark(bytes, path_), path_);
        while (scanner.next_line()) read_line(scanner);
    }

  private:
    void read_line(const TextScanner& scanner) {
        const auto& words = scanner.words();
        if (words.size() > 1 && names_image(words[0])) return read_image(scanner);
        if (words[0] == "newmtl") materials_.list.push_back({rest(words, 1), {}, ""});
        if (words[0] == "Kd" && words.size() > 3 && !materials_.list.empty())
            materials_.list.back().colour = {scanner.number(1, "red"), scanner.number(2, "green"),
                                             scanner.number(3, "blue")};
        materials_.text += rest(words, 0) + "\n";
    }
    void read_image(const TextScanner& scanner) {
        const auto& words = scanner.words();
        const std::size_t at = image_word(words);
        std::string name = rest(words, at);
        std::replace(name.begin(), name.end(), '\\', '/');
        const std::string image = (fs::path(path_).parent_path() / name).string();
        if (!fs::is_regular_file(image))
            throw IoError(fmt::format("{}:{}: the texture {} is missing (looked for at {})", path_,
                                      scanner.line(), printable(name), printable(image)));
        if (words[0] == "map_Kd" && !materials_.list.empty()) materials_.list.back().texture = image;
        for (std::size_t i = 0; i < at; ++i) materials_.text += std::string(words[i]) + " ";
        materials_.text += name_of(image) + "\n";
    }
    /// The image's name beside the MTL file; images of one name from different folders get numbers.
    std::string name_of(const std::string& image) {
        const fs::path path(image);
        std::string name = path.filename().string();
        for (int number = 2;; ++number) {
            const auto known = std::find_if(materials_.images.begin(), materials_.images.end(),
                                            [&](const auto& other) { return other.first == name; });
            if (known == materials_.images.end()) break;
            if (known->second == image) return name;
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
    Materials& materials_;
};

}  // namespace

const Material* Materials::find(const std::string& name) const {
    const auto found =
        std::find_if(list.begin(), list.end(), [&](const Material& other) { return other.name == name; });
    return found == list.end() ? nullptr : &*found;
}

Materials read_materials(const ObjModel& model, const std::string& obj_path) {
    Materials materials;
    for (const std::string& library : model.libraries) {
        const std::string path = (fs::path(obj_path).parent_path() / library).string();
        if (!fs::is_regular_file(path))
            throw IoError(fmt::format("{}: its materials {} are missing (looked for at {})", obj_path,
                                      printable(library), printable(path)));
        LibraryReader(path, materials).read();
    }
    return materials;
}

std::string media_type(std::string_view image) {
    if (image.starts_with("\x89PNG")) return "image/png";
    if (image.starts_with("\xff\xd8\xff")) return "image/jpeg";
    return "";
}

}  // namespace varimap
