"""Figures for print, with matplotlib: column-sized, readable in grey, as PDF, SVG and PNG."""
