// VAMP sorts by the library pdqsort, which its source distribution leaves out; the order of equal elements does not matter there.
#pragma once

#include <algorithm>

template <class Iterator, class... Less>
void pdqsort(Iterator first, Iterator last, Less... less)
{
    std::sort(first, last, less...);
}

template <class Iterator, class... Less>
void pdqsort_branchless(Iterator first, Iterator last, Less... less)
{
    std::sort(first, last, less...);
}
