#pragma once

#include <string_view>

namespace varimap {

/// One tag of an XML text, and the text up to the next one.
struct XmlTag {
    std::string_view name;  ///< without a namespace's prefix; closing ones begin with /
    std::string_view attributes, text;
    bool closes_itself = false;

    /// Empty where there is none.
    std::string_view attribute(std::string_view key) const;
};

/// The tags of an XML text, one after the other, without comments. Nothing is checked: what is no XML gives
/// tags that mean nothing.
class XmlTags {
  public:
    explicit XmlTags(std::string_view text) : text_(text) {}
    /// False behind the last one.
    bool next(XmlTag& tag);

  private:
    void skip(std::string_view mark);
    std::string_view text_;
    std::size_t at_ = 0;
};

}  // namespace varimap
