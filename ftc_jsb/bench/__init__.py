"""What `ftc-jsb bench` measures: the cost of a step, of a flight, of many, and of starting up."""
