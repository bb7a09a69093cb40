"""What a command does around flights: folders, saving as it goes, checking, listing."""
