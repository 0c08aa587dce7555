% SPDX-License-Identifier: BSD-3-Clause
% Copyright 2026 the Yoke authors
%
% Loads results as a user of Octave would, and prints as load.py does:
%   octave-cli load.m csv|mat|hdf5 FOLDER
function show_column(table, name, unit, values)
  if ischar(values)
    values = cellstr(values);  % of a file of HDF5: a row for each text
  end
  n = numel(values);
  if n == 0
    return
  end
  printf("%s\t%s\t%s\t%d", table, name, unit, n);
  for i = [1, min(8, n), n]
    if iscell(values)
      printf("\t%s", strtok(values{i}, char(0)));
    else
      printf("\t%s", num2hex(values(i)));
    end
  end
  printf("\n");
end

function show_struct(results)
  for table = fieldnames(results)'
    group = results.(table{1});
    if !isstruct(group) || any(strcmp(table{1}, {"names", "units"}))
      continue
    end
    for field = fieldnames(group)'
      name = field{1};
      unit = "";
      if isfield(results, "names")
        name = results.names.(table{1}).(field{1});
        unit = results.units.(table{1}).(field{1});
      end
      show_column(table{1}, name, unit, group.(field{1}));
    end
  end
  printf("summary\t%s\n", strrep(results.summary, "\n", " "));
end

how = argv(){1};
folder = argv(){2};
if strcmp(how, "csv")
  for file = glob([folder "/*.csv"])'
    [~, table] = fileparts(file{1});
    id = fopen(file{1});
    names = strsplit(fgetl(id), ",");
    cells = textscan(id, repmat("%s", 1, numel(names)), "delimiter", ",");
    fclose(id);
    for i = 1:numel(names)
      numbers = str2double(cells{i});
      if any(isnan(numbers) & !strcmp(cells{i}, "nan"))
        show_column(table, names{i}, "", cells{i});
      else
        show_column(table, names{i}, "", numbers);
      end
    end
  end
elseif strcmp(how, "mat")
  show_struct(load([folder "/results.mat"]));
else
  show_struct(load("-hdf5", [folder "/results.h5"]));
end
