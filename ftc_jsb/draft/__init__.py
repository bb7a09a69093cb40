"""An `aircraft.toml` drafted from an aircraft of the installed jsbsim package."""
