"""What `ftc-jsb bench` measures."""
