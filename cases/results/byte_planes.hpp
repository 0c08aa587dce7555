// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Chunks of numbers as HDF5's filters "shuffle" and "deflate" would write them, so that any HDF5 reads
// them, at a speed that suits what runs record: of smooth columns only the bytes of sign, exponent and
// first digits repeat, and searching the others for anything costs time and finds nothing.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace yoke::cases {

/// Numbers that are `step` apart, plus `shift`, as bytes that follow each other.
void copy_numbers(const double* first, std::size_t step, double shift, std::size_t count,
                  unsigned char* to);

/// Byte k of every element, then byte k + 1 of every element: what HDF5 calls shuffled.
/// `bytes` holds elements of `size` bytes each, at least one.
void shuffle_bytes(std::span<const unsigned char> bytes, std::size_t size,
                   std::vector<unsigned char>& planes);

/// A zlib stream (RFC 1950) of planes of `count` bytes each: those in which bytes repeat as
/// runs, the others as they are. False, and nothing of use in `stream`, if that saves too little.
bool compress_planes(const std::vector<unsigned char>& planes, std::size_t count,
                     std::vector<unsigned char>& stream);

}  // namespace yoke::cases
