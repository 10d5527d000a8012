#include "stages/inspect/inspect.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "stages/inspect/contents.h"
#include "stages/inspect/formats.h"
#include "stages/inspect/lineage.h"
#include "varimap/artifact/artifact.h"
#include "varimap/artifact/file_status.h"
#include "varimap/mesh_files/mesh_file.h"

namespace varimap {
namespace {

/// Lists contents: facts as they are, arrays by shape and range.
class Summary : public ContentsVisitor {
  public:
    explicit Summary(Detail detail = Detail::all) : detail_(detail) {}
    void fact(const std::string& name, const std::string& value) override { line(name, value); }
    void array(const std::string& name, const ArrayView& array) override {
        line(name, std::visit([&](const auto* data) { return described(data, array); }, array.data));
    }
    void sparse(const std::string& name, const SparseMatrix& matrix) override {
        const auto rows = std::max<Eigen::Index>(1, matrix.rows());
        line(name, fmt::format("sparse {} x {}, {} entries, {:.1f} per row", matrix.rows(), matrix.cols(),
                               matrix.nonZeros(), double(matrix.nonZeros()) / double(rows)));
    }
    void mesh(const std::string& name, const TriangleMesh& mesh) override {
        line(name, fmt::format("surface of {} vertices, {} faces", mesh.vertex_count(), mesh.face_count()));
    }
    void text(const std::string& name, const std::string& content) override {
        constexpr auto few = 6;
        const auto lines = std::count(content.begin(), content.end(), '\n');
        if (detail_ == Detail::screen && lines > few)
            line(name, fmt::format("{} lines: --trace shows them", lines));
        else if (!content.empty())
            text_ += "  " + name + "\n" + indented(content);
    }
    std::string result() const { return text_; }

  private:
    template <class Scalar>
    static std::string described(const Scalar* data, const ArrayView& array) {
        const auto values = Eigen::Map<const Eigen::Array<Scalar, Eigen::Dynamic, 1>>(data, array.size());
        std::string text = fmt::format("{} {}", sizeof(Scalar) == sizeof(int) ? "int" : "double",
                                       fmt::join(array.shape, " x "));
        if (values.size() > 0)
            text += fmt::format(", from {:.6g} to {:.6g}, mean {:.6g}", double(values.minCoeff()),
                                double(values.maxCoeff()), values.template cast<double>().mean());
        return text;
    }
    static std::string indented(const std::string& content) {
        std::string result = "    ";
        for (const char c : content) result += c == '\n' ? std::string("\n    ") : std::string(1, c);
        return result.substr(0, result.find_last_not_of(" \n") + 1) + "\n";
    }
    void line(const std::string& name, const std::string& value) {
        text_ += fmt::format("  {:<22} {}\n", name, value);
    }
    Detail detail_;
    std::string text_;
};

class Export : public ContentsVisitor {
  public:
    explicit Export(const std::string& folder) : folder_(folder) {}
    void fact(const std::string&, const std::string&) override {}
    void array(const std::string& name, const ArrayView& array) override {
        save(name + ".npy", to_npy(array));
    }
    void sparse(const std::string& name, const SparseMatrix& matrix) override {
        save(name + ".mtx", to_matrix_market(matrix));
        save(name + ".npz", to_npz(matrix));
    }
    void mesh(const std::string& name, const TriangleMesh& mesh) override {
        save(name + ".ply", to_ply(mesh));
        array(name + "_vertices", view(mesh.vertices));
        array(name + "_faces", view(mesh.faces));
    }
    void text(const std::string& name, const std::string& content) override { save(name, content); }

  private:
    void save(const std::string& name, const std::string& bytes) const {
        write_file_atomically((std::filesystem::path(folder_) / name).string(), bytes);
    }
    std::string folder_;
};

/// Kind and origin in a line, parameters in a few.
std::string short_header(const Header& header) {
    constexpr std::size_t width = 110;
    std::string text =
        fmt::format("{} of {} {}, schema {}\n", header.kind, header.stage, header.version, header.schema);
    std::string line = " ";
    for (const auto& [name, value] : header.parameters) {
        const std::string word = fmt::format(" {}={}", name, value);
        if (line.size() + word.size() > width) text += line + "\n", line.assign(1, ' ');
        line += word;
    }
    return line == " " ? text : text + line + "\n";
}

/// Of a lineage, what the artifact itself was made from.
std::string first_generation(const std::string& made_from) {
    std::string text;
    for (std::size_t at = 0; at < made_from.size();) {
        const std::size_t end = std::min(made_from.find('\n', at), made_from.size() - 1) + 1;
        if (made_from.compare(at, 4, "    ") != 0) text += made_from.substr(at, end - at);
        at = end;
    }
    return text;
}

}  // namespace

std::string summarise(const std::string& path, Detail detail) {
    Summary summary(detail);
    visit_artifact(path, summary);
    const Header header = read_header(path);
    const std::string made_from = lineage(path);
    const std::string from = detail == Detail::all ? made_from : first_generation(made_from);
    return (detail == Detail::all ? header_text(header) : short_header(header)) + "\nmade from\n" +
           (from.empty() ? "  nothing\n" : from) + "\nholds\n" + summary.result();
}

std::optional<Error> check(const std::string& path) {
    try {
        Summary summary;
        visit_artifact(path, summary);
        return std::nullopt;
    } catch (const Error& error) {
        return error;
    }
}

void export_contents(const std::string& path, const std::string& folder) {
    make_folder(folder);
    Export writer(folder);
    visit_artifact(path, writer);
}

}  // namespace varimap
