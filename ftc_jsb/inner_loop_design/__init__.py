"""Design of the inner loop's numbers: airframe measured, references searched for, steps flown."""
