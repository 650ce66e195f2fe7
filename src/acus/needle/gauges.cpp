#include "acus/needle/gauges.h"

namespace acus::needle {
namespace {

constexpr Gauge all_gauges[] = {
    {"14G", 2.108e-3, 1.6e-3},    {"15G", 1.829e-3, 1.372e-3},  {"16G", 1.651e-3, 1.194e-3},
    {"17G", 1.473e-3, 1.067e-3},  {"18G", 1.27e-3, 0.838e-3},   {"19G", 1.067e-3, 0.686e-3},
    {"20G", 0.9081e-3, 0.603e-3}, {"21G", 0.8192e-3, 0.514e-3}, {"22G", 0.7176e-3, 0.413e-3},
    {"23G", 0.6414e-3, 0.337e-3}, {"24G", 0.5652e-3, 0.311e-3}, {"25G", 0.5144e-3, 0.26e-3},
    {"26G", 0.4636e-3, 0.26e-3},  {"27G", 0.4128e-3, 0.21e-3},  {"28G", 0.362e-3, 0.184e-3},
    {"29G", 0.3366e-3, 0.184e-3}, {"30G", 0.3112e-3, 0.159e-3},
};

constexpr Material all_materials[] = {
    {"steel", "Steel", 200e9, 7850.0, "the paper's Table I"},
    {"titanium", "Titanium alloy", 114e9, 4430.0, "Ti-6Al-4V, ASM handbook value"},
    {"nitinol", "Nitinol", 75e9, 6450.0, "austenite, linear here"},
    {"peek", "PEEK", 3.6e9, 1300.0, "unfilled polymer, data-sheet value"},
};

}  // namespace

std::span<const Gauge> gauges() { return all_gauges; }
std::span<const Material> materials() { return all_materials; }

}  // namespace acus::needle
