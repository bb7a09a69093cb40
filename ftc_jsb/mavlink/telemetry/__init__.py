"""Messages that the vehicle sends: what a row of the recording says."""
