// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/cases/results/byte_planes.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>

namespace yoke::cases {

namespace {

using Bytes = std::vector<unsigned char>;

/// Adler-32 (RFC 1950): the sum of all bytes, and the sum of that sum after each of them. The bytes of 16
/// lanes are summed side by side, which a compiler makes vectors of.
std::uint32_t adler32_of(std::span<const unsigned char> bytes) {
  constexpr std::uint32_t modulus = 65521;
  constexpr std::size_t lanes = 16, block = 256 * lanes;  // sums of a lane's bytes fit into 16 bits
  std::uint32_t a = 1, b = 0;
  std::size_t i = 0;
  while (i + lanes <= bytes.size()) {
    const std::size_t rows = std::min(bytes.size() - i, block) / lanes;
    std::array<std::uint16_t, lanes> sum{};
    std::array<std::uint32_t, lanes> sum_of_sums{};
    for (std::size_t row = 0; row < rows; ++row)
      for (std::size_t k = 0; k < lanes; ++k) {
        sum_of_sums[k] += sum[k];
        sum[k] = static_cast<std::uint16_t>(sum[k] + bytes[i + row * lanes + k]);
      }
    b = static_cast<std::uint32_t>((b + std::uint64_t{rows} * lanes * a) % modulus);
    std::uint64_t before = 0;
    for (std::size_t k = 0; k < lanes; ++k) {
      before += lanes * std::uint64_t{sum_of_sums[k]} + (lanes - k) * std::uint64_t{sum[k]};
      a += sum[k];
    }
    b = static_cast<std::uint32_t>((b + before) % modulus);
    a %= modulus;
    i += rows * lanes;
  }
  for (; i < bytes.size(); ++i) b += a += bytes[i];
  return b % modulus << 16 | a % modulus;
}

/// Bits of a deflate stream (RFC 1951), first bit lowest.
class Bits {
 public:
  explicit Bits(Bytes& out) : out_(out) {}
  void put(std::uint64_t bits, unsigned count) {
    held_ |= bits << count_;
    count_ += count;
    while (count_ >= 32) {
      for (int k = 0; k < 4; ++k) out_.push_back(static_cast<unsigned char>(held_ >> 8 * k));
      held_ >>= 32;
      count_ -= 32;
    }
  }
  void align() {
    for (; count_ > 0; count_ -= std::min(count_, 8u)) {
      out_.push_back(static_cast<unsigned char>(held_));
      held_ >>= 8;
    }
  }

 private:
  Bytes& out_;
  std::uint64_t held_ = 0;
  unsigned count_ = 0;
};

struct Code {
  std::uint16_t bits = 0;
  std::uint8_t count = 0;
};

/// Code of a literal or a length in a block of fixed codes; they are packed from their highest bit on.
constexpr Code fixed_code(unsigned symbol) {
  unsigned code = 0x30 + symbol, count = 8;
  if (symbol >= 280) {
    code = 0xC0 + symbol - 280;
  } else if (symbol >= 256) {
    code = symbol - 256;
    count = 7;
  } else if (symbol >= 144) {
    code = 0x190 + symbol - 144;
    count = 9;
  }
  unsigned reversed = 0;
  for (unsigned k = 0; k < count; ++k) reversed |= (code >> k & 1u) << (count - 1 - k);
  return {static_cast<std::uint16_t>(reversed), static_cast<std::uint8_t>(count)};
}

constexpr std::array<Code, 286> make_codes() {
  std::array<Code, 286> codes{};
  for (unsigned symbol = 0; symbol < codes.size(); ++symbol) codes[symbol] = fixed_code(symbol);
  return codes;
}
constexpr std::array<Code, 286> codes = make_codes();

std::size_t run_length(const unsigned char* first, const unsigned char* end) {
  const unsigned char* p = first;
  const std::uint64_t same = 0x0101010101010101u * *first;
  for (std::uint64_t next; p + sizeof next <= end; p += sizeof next) {
    std::memcpy(&next, p, sizeof next);
    if (next != same) break;
  }
  while (p < end && *p == *first) ++p;
  return static_cast<std::size_t>(p - first);
}

/// `count` >= 3 repetitions of the byte before: lengths that need no extra bits, at distance 1.
void put_repetitions(Bits& bits, std::size_t count) {
  constexpr unsigned bits_of_distance = 5;
  const auto put = [&](unsigned symbol) {
    bits.put(codes[symbol].bits, codes[symbol].count + bits_of_distance);
  };
  // What is left must not be 1 or 2: no code is that short.
  for (; count == 258 || count >= 261; count -= 258) put(285);
  while (count > 0) {
    std::size_t length = std::min<std::size_t>(count, 10);
    const std::size_t left = count - length;
    if (left == 1 || left == 2) length -= 3 - left;
    put(static_cast<unsigned>(254 + length));
    count -= length;
  }
}

void put_runs(std::span<const unsigned char> plane, Bytes& stream) {
  Bits bits(stream);
  bits.put(0b010, 3);  // not the last block, fixed codes
  const unsigned char* end = plane.data() + plane.size();
  for (const unsigned char* p = plane.data(); p < end;) {
    const std::size_t run = run_length(p, end);
    const Code literal = codes[*p];
    const std::size_t literals = run < 4 ? run : 1;
    for (std::size_t i = 0; i < literals; ++i) bits.put(literal.bits, literal.count);
    if (run > literals) put_repetitions(bits, run - literals);
    p += run;
  }
  bits.put(codes[256].bits, codes[256].count);
  bits.put(0b000, 3);  // an empty block as it is ends at a whole byte
  bits.align();
  stream.insert(stream.end(), {0x00, 0x00, 0xff, 0xff});
}

void put_as_it_is(std::span<const unsigned char> plane, Bytes& stream) {
  constexpr std::size_t largest = 65535;
  while (!plane.empty()) {
    const std::size_t n = std::min(plane.size(), largest);
    const auto low = static_cast<unsigned char>(n), high = static_cast<unsigned char>(n >> 8);
    stream.insert(stream.end(), {0x00, low, high, static_cast<unsigned char>(~low),
                                 static_cast<unsigned char>(~high)});
    stream.insert(stream.end(), plane.begin(), plane.begin() + static_cast<std::ptrdiff_t>(n));
    plane = plane.subspan(n);
  }
}

/// Worth the time: most bytes are like the one before, as far as every fourth stretch shows.
bool repeats(std::span<const unsigned char> plane) {
  constexpr std::size_t stretch = 64;
  std::size_t same = 0, seen = 0;
  for (std::size_t begin = 1; begin < plane.size(); begin += 4 * stretch) {
    const std::size_t end = std::min(plane.size(), begin + stretch);
    unsigned here = 0;
    for (std::size_t i = begin; i < end; ++i) here += plane[i] == plane[i - 1] ? 1u : 0u;
    same += here;
    seen += end - begin;
  }
  return 5 * same >= 3 * seen;
}

/// Rows and columns of 8 x 8 bytes exchanged.
void transpose(std::array<std::uint64_t, 8>& x) {
  const auto exchange = [&](std::size_t i, std::size_t j, unsigned shift, std::uint64_t mask) {
    const std::uint64_t t = (x[i] >> shift ^ x[j]) & mask;
    x[j] ^= t;
    x[i] ^= t << shift;
  };
  for (std::size_t i = 0; i < 4; ++i) exchange(i, i + 4, 32, 0x00000000ffffffffu);
  for (const std::size_t i : {0u, 1u, 4u, 5u}) exchange(i, i + 2, 16, 0x0000ffff0000ffffu);
  for (const std::size_t i : {0u, 2u, 4u, 6u}) exchange(i, i + 1, 8, 0x00ff00ff00ff00ffu);
}

}  // namespace

void copy_numbers(const double* first, std::size_t step, double shift, std::size_t count,
                  unsigned char* to) {
  for (std::size_t i = 0; i < count; ++i) {
    const double x = shift == 0.0 ? first[i * step] : first[i * step] + shift;  // keeps -0
    std::memcpy(to + i * sizeof x, &x, sizeof x);
  }
}

void shuffle_bytes(std::span<const unsigned char> bytes, std::size_t size, Bytes& planes) {
  const std::size_t count = bytes.size() / size;
  planes.resize(bytes.size());
  std::size_t done = 0;
  if (size == 8 && std::endian::native == std::endian::little) {
    for (; done + 8 <= count; done += 8) {
      std::array<std::uint64_t, 8> eight;
      std::memcpy(eight.data(), bytes.data() + 8 * done, sizeof eight);
      transpose(eight);
      for (std::size_t k = 0; k < 8; ++k)
        std::memcpy(planes.data() + k * count + done, &eight[k], 8);
    }
  }
  for (std::size_t k = 0; k < size; ++k) {
    unsigned char* plane = planes.data() + k * count;
    for (std::size_t i = done; i < count; ++i) plane[i] = bytes[i * size + k];
  }
}

bool compress_planes(const Bytes& planes, std::size_t count, Bytes& stream) {
  stream.assign(2, 0x78);
  stream.back() = 0x01;
  bool worth = false;
  for (std::size_t begin = 0; begin < planes.size(); begin += count) {
    const std::span<const unsigned char> plane(planes.data() + begin, count);
    if (repeats(plane)) {
      worth = true;
      put_runs(plane, stream);
    } else {
      put_as_it_is(plane, stream);
    }
  }
  if (!worth || stream.size() >= planes.size()) return false;
  stream.insert(stream.end(), {0x01, 0x00, 0x00, 0xff, 0xff});  // the last block, empty
  const std::uint32_t check = adler32_of(planes);
  for (int k = 3; k >= 0; --k) stream.push_back(static_cast<unsigned char>(check >> 8 * k));
  return true;
}

}  // namespace yoke::cases
