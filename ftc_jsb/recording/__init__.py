"""A flight as data: columns, commands, outcome, the NetCDF file."""
