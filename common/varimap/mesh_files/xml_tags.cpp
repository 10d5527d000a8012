#include "varimap/mesh_files/xml_tags.h"

#include <algorithm>

namespace varimap {
namespace {

constexpr std::string_view xml_blanks = " \t\r\n";

std::string_view without_blanks_behind(std::string_view text) {
    return text.substr(0, text.find_last_not_of(xml_blanks) + 1);
}

/// Where the tag that begins at `begin` ends: values of attributes may hold a >.
std::size_t end_of_tag(std::string_view text, std::size_t begin) {
    for (std::size_t at = begin; (at = text.find_first_of("\"'>", at)) != text.npos; ++at) {
        if (text[at] == '>') return at;
        at = text.find(text[at], at + 1);
        if (at == text.npos) break;
    }
    return std::min(text.find('>', begin), text.size());  // a quote without a partner says nothing
}

}  // namespace

std::string_view XmlTag::attribute(std::string_view key) const {
    for (std::size_t at = 0;;) {
        const std::size_t begin = attributes.find_first_not_of(xml_blanks, at);
        const std::size_t equals = begin == attributes.npos ? begin : attributes.find('=', begin);
        const std::size_t quote =
            equals == attributes.npos ? equals : attributes.find_first_of("\"'", equals);
        if (quote == attributes.npos) return {};
        const std::size_t end = attributes.find(attributes[quote], quote + 1);
        if (end == attributes.npos) return {};
        if (without_blanks_behind(attributes.substr(begin, equals - begin)) == key)
            return attributes.substr(quote + 1, end - quote - 1);
        at = end + 1;
    }
}

bool XmlTags::next(XmlTag& tag) {
    for (;;) {
        at_ = text_.find('<', at_);
        if (at_ == text_.npos) return false;
        if (text_.substr(at_).starts_with("<!--"))
            skip("-->");
        else if (text_.substr(at_).starts_with("<![CDATA["))
            skip("]]>");
        else
            break;
    }
    const std::size_t end = end_of_tag(text_, at_);
    std::string_view inside = text_.substr(at_ + 1, end - at_ - 1);
    tag.closes_itself = inside.ends_with('/');
    if (tag.closes_itself) inside.remove_suffix(1);
    const std::size_t blank = std::min(inside.find_first_of(xml_blanks), inside.size());
    tag.name = inside.substr(0, blank);
    tag.attributes = inside.substr(blank);
    if (const std::size_t colon = tag.name.find(':'); colon != tag.name.npos)
        tag.name.remove_prefix(colon + 1);
    at_ = std::min(end + 1, text_.size());
    tag.text = text_.substr(at_, std::min(text_.find('<', at_), text_.size()) - at_);
    return true;
}

void XmlTags::skip(std::string_view mark) {
    const std::size_t end = text_.find(mark, at_);
    at_ = end == text_.npos ? text_.size() : end + mark.size();
}

}  // namespace varimap
