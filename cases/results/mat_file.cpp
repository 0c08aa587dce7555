// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/cases/results/mat_file.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include <yoke/core/error.hpp>

#ifdef YOKE_MATIO
#include <matio.h>

#include <cerrno>
#include <cstring>
#include <memory>
#include <system_error>
#endif

namespace yoke::cases {

std::vector<std::string> field_names(const OutputTable& table) {
  constexpr std::size_t longest = 63;
  std::vector<std::string> fields;
  for (const OutputColumn& c : table.columns) {
    std::string field = c.name;
    for (char& x : field)
      if (std::isalnum(static_cast<unsigned char>(x)) == 0) x = '_';
    if (std::isalpha(static_cast<unsigned char>(field.front())) == 0) field.insert(0, "x");
    field.resize(std::min(field.size(), longest));
    const std::string base = field;
    for (int n = 2; std::ranges::find(fields, field) != fields.end(); ++n) {
      const std::string ending = fmt::format("_{}", n);
      field = base.substr(0, longest - ending.size()) + ending;
    }
    fields.push_back(field);
  }
  return fields;
}

#ifdef YOKE_MATIO

const bool has_matio = true;

namespace {

/// A variable owns what is put into it.
using Variable = std::unique_ptr<matvar_t, decltype(&Mat_VarFree)>;

Variable owned(matvar_t* variable) {
  if (variable == nullptr) throw std::bad_alloc();
  return {variable, &Mat_VarFree};
}

Variable text_variable(const char* name, std::string_view text) {
  std::size_t size[2] = {text.empty() ? 0u : 1u, text.size()};
  std::string copy(text);
  return owned(Mat_VarCreate(name, MAT_C_CHAR, MAT_T_UTF8, 2, size, copy.data(), 0));
}

Variable column_variable(const OutputColumn& c, std::size_t rows) {
  std::size_t size[2] = {rows, 1};
  if (c.text) {
    Variable cells = owned(Mat_VarCreate(nullptr, MAT_C_CELL, MAT_T_CELL, 2, size, nullptr, 0));
    for (std::size_t i = 0; i < rows; ++i)
      Mat_VarSetCell(cells.get(), static_cast<int>(i), text_variable(nullptr, c.text(i)).release());
    return cells;
  }
  std::vector<double> numbers(rows);
  for (std::size_t i = 0; i < rows; ++i) numbers[i] = c.number(i);
  return owned(Mat_VarCreate(nullptr, MAT_C_DOUBLE, MAT_T_DOUBLE, 2, size, numbers.data(), 0));
}

Variable struct_variable(const std::string& name, const std::vector<std::string>& fields) {
  std::vector<const char*> texts;
  for (const std::string& f : fields) texts.push_back(f.c_str());
  std::size_t size[2] = {1, 1};
  return owned(Mat_VarCreateStruct(name.c_str(), 2, size, texts.data(),
                                   static_cast<unsigned>(texts.size())));
}

void set_field(const Variable& into, const std::string& field, Variable value) {
  Mat_VarSetStructFieldByName(into.get(), field.c_str(), 0, value.release());
}

/// Everything that goes into the file.
std::vector<Variable> variables(const std::vector<OutputTable>& tables,
                                const std::string& summary) {
  std::vector<std::string> table_names;
  for (const OutputTable& t : tables) table_names.push_back(t.name);
  std::vector<Variable> all;
  Variable names = struct_variable("names", table_names),
           units = struct_variable("units", table_names);
  for (const OutputTable& t : tables) {
    const std::vector<std::string> fields = field_names(t);
    Variable table = struct_variable(t.name, fields), name = struct_variable(t.name, fields),
             unit = struct_variable(t.name, fields);
    for (std::size_t i = 0; i < fields.size(); ++i) {
      set_field(table, fields[i], column_variable(t.columns[i], t.rows));
      set_field(name, fields[i], text_variable(nullptr, t.columns[i].name));
      set_field(unit, fields[i], text_variable(nullptr, t.columns[i].unit));
    }
    set_field(names, t.name, std::move(name));
    set_field(units, t.name, std::move(unit));
    all.push_back(std::move(table));
  }
  all.push_back(std::move(names));
  all.push_back(std::move(units));
  all.push_back(text_variable("summary", summary));
  return all;
}

}  // namespace

void write_mat(const std::filesystem::path& path, const std::vector<OutputTable>& tables,
               const std::string& summary) {
  std::filesystem::path part = path;
  part += ".part";
  const auto fail = [&](int error) {
    std::error_code ignored;
    std::filesystem::remove(part, ignored);
    throw OutputError(fmt::format("cannot write '{}': {}", path.string(),
                                  error != 0 ? std::strerror(error) : "matio failed"));
  };
  errno = 0;
  mat_t* file = Mat_CreateVer(part.c_str(), nullptr, MAT_FT_MAT5);
  if (file == nullptr) fail(errno);
  bool ok = true;
  for (const Variable& v : variables(tables, summary))
    ok = ok && Mat_VarWrite(file, v.get(), MAT_COMPRESSION_ZLIB) == 0;
  ok = Mat_Close(file) == 0 && ok;
  // matio does not look whether what it writes arrives.
  const int full[] = {ENOSPC, EFBIG, EDQUOT, EIO};
  if (!ok || std::ranges::find(full, errno) != std::end(full)) fail(errno);
  std::error_code error;
  std::filesystem::rename(part, path, error);
  if (error) fail(error.value());
}

#else

const bool has_matio = false;

void write_mat(const std::filesystem::path&, const std::vector<OutputTable>&, const std::string&) {
  throw ModelError("built without matio");
}

#endif

}  // namespace yoke::cases
